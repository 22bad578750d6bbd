// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/ggx.h"
#include "sateen/texture/lobe_filter.h"

namespace sateen::texture {

/// What one lobe sends to the eye under a directional light of irradiance pi across its direction: GGX
/// without Fresnel, times the cosine about the texel's own normal.
inline double lobe_radiance(const LobeTexel& texel, const Vec3& light, const Vec3& view) {
  const Mat3 frame = normal_frame(texel.normal);
  const Vec3 l = frame.transpose() * light;
  const Vec3 v = frame.transpose() * view;
  if (l.z() <= 0 || v.z() <= 0) return 0;
  return kPi * brdf::ggx_brdf(brdf::roughness_from_matrix(texel.s), Vec3::Ones(), l, v).x() * l.z();
}

}  // namespace sateen::texture
