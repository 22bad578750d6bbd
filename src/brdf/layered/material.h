// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "sateen/brdf/diffuse_base.h"
#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/ggx.h"
#include "sateen/core/image.h"

namespace sateen::brdf {

/// Fibres that change from point to point, brushed pile: x / 2 + 1/2 and y / 2 + 1/2 of the unit fibre in the
/// shading frame, the end that points out of the surface, in the first two channels, like a normal map.
/// Repeats over the mesh's UVs, v up.
struct FibreMap {
  std::shared_ptr<const Image> picture;
  Vec2 repeat{1, 1};

  /// Read bilinearly and made unit; z >= 0, and not quite upright (kUprightTilt).
  Vec3 fibre(const Vec2& uv) const;
};

/// A material of analytic layers, from the bottom: diffuse base, GGX reflection, fuzz. docs/materials.md has
/// its file.
struct LayeredMaterial {
  DiffuseBase base;

  std::optional<GgxParameters> specular;
  /// Lookups along the stretched lobe in environment light; 0: 1 for equal alphas, 8 otherwise.
  int lobe_samples = 0;

  std::optional<FuzzParameters> fuzz;
  std::optional<FibreMap> fuzz_fibres;  ///< in place of the fuzz's tilt and azimuth
  bool fuzz_scattered_down = true;      ///< off: P_s = 0 under the base layer, the slides' comparison
  /// Turns the fuzz's normal from the shading normal (0) to the mesh's without normal map (1): softer fuzz
  /// over a detailed base. The slides' "normal smoothing".
  double fuzz_smoothing = 0;
};

/// Its parameters by their JSON paths: "base.color", "specular.alpha_t", "fuzz.density".
/// Setting one of a layer that is not there adds the layer.
std::span<const appearance::ParameterField<LayeredMaterial>> layered_parameters();

/// The same surface as the evaluators want it: alpha_t >= alpha_b, no fibre quite upright.
LayeredMaterial normalised(LayeredMaterial material);

}  // namespace sateen::brdf
