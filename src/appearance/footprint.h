// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "sateen/core/vector.h"

namespace sateen::appearance {

/// The mip level that a pixel's footprint (Surface::footprint, times the repeats of the map) asks of a map of
/// width x height texels: the logarithm of the longer side in texels, not clamped to the levels there are;
/// far below 0 for a point. shaders/surface/footprint.glsl does the same.
inline double map_level(const Vec4& footprint, int width, int height) {
  const Vec2 size(width, height);
  const double right = footprint.head<2>().cwiseProduct(size).squaredNorm();
  const double up = footprint.tail<2>().cwiseProduct(size).squaredNorm();
  return 0.5 * std::log2(std::max({right, up, 1e-12}));
}

}  // namespace sateen::appearance
