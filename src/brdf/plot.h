// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/brdf/evaluation.h"

namespace sateen::brdf {

struct PlotSettings {
  std::string title = {};
  std::vector<double> light_angles = {0, radians(30), radians(60)};  ///< from the normal, in (-pi/2, pi/2)
  bool with_cosine =
      false;  ///< lobes times v.n, the radiance a lamp causes per area seen, in place of the BRDF
  bool view_independent =
      false;  ///< the model ignores the view (fibre diffuse): plot against the light instead
};

/// A drawing (SVG) of a reflectance model: polar lobes over views in the plane of the tangent and in that of
/// the bitangent, one curve a light angle, and the directional albedo against the light's angle in both
/// planes. For view-independent models the lobes run over lights and the albedo panel shows the value itself.
std::string brdf_plot(const BrdfFunction& brdf, const PlotSettings& settings);

/// The share of light from `light` that is reflected: the integral of the BRDF times v.n over views, as
/// luminance.
double directional_albedo(const BrdfFunction& brdf, const Vec3& light);

}  // namespace sateen::brdf
