// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "sateen/texture/lobe_filter.h"

namespace sateen {

/// What one lobe sends to the eye under a directional light of irradiance pi across its direction: GGX with
/// height-correlated Smith masking and no Fresnel, times the cosine about the texel's own normal.
inline double lobe_radiance(const LobeTexel& texel, const Vec3& light, const Vec3& view) {
  const Mat3 frame = normal_frame(texel.normal);
  const Vec3 l = frame.transpose() * light;
  const Vec3 v = frame.transpose() * view;
  if (l.z() <= 0 || v.z() <= 0) return 0;
  const Vec3 h = (l + v).normalized();
  const double det = std::max(texel.s.determinant(), 1e-14);
  const auto quadratic = [](const Mat2& m, const Vec3& d) { return d.head<2>().dot(m * d.head<2>()); };
  Mat2 adjugate;
  adjugate << texel.s(1, 1), -texel.s(0, 1), -texel.s(0, 1), texel.s(0, 0);
  const double q = quadratic(adjugate, h) / det + h.z() * h.z();
  const double ndf = 1 / (std::sqrt(det) * q * q);
  const auto lambda = [&](const Vec3& d) { return std::sqrt(d.z() * d.z() + quadratic(texel.s, d)); };
  const double visibility = 0.5 / (l.z() * lambda(v) + v.z() * lambda(l));
  return ndf * visibility * l.z();
}

}  // namespace sateen
