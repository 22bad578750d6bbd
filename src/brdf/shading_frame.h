// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/appearance/surface.h"

namespace sateen::brdf {

/// Views at and behind the rim, where interpolated normals turn away, are taken this far above the horizon.
inline constexpr double kLowestView = 1e-3;

/// A direction in a shading frame with z >= kLowestView.
Vec3 lifted_view(const Vec3& view);

/// A direction in a frame whose x axis lies at `azimuth`.
Vec3 turned(const Vec3& direction, double azimuth);

/// Tangent x, bitangent y, normal z of a surface point, in view space, and the view in it, never below the
/// horizon. shaders/appearance/shading_frame.glsl does the same.
struct ShadingFrame {
  Mat3 axes;  ///< columns
  Vec3 view;

  ShadingFrame(const appearance::Surface& surface, const Vec3& normal);
  /// A direction of view space in the frame.
  Vec3 into(const Vec3& direction) const { return axes.transpose() * direction; }
};

}  // namespace sateen::brdf
