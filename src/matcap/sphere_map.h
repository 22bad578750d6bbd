// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/core/vector.h"

namespace sateen::matcap {

/// Colours over all directions as a dual paraboloid map (Heidrich and Seidel 1998): two square pictures of
/// equal size, front for w.z >= 0 and back for w.z < 0, both indexed by the texture coordinate w.xy / (2 (1 +
/// |w.z|)) + 1/2, v up. Each picture goes on past its hemisphere into its corners (the same formula read
/// backwards), so that bilinear lookups meet at the equator without a seam.
struct SphereMap {
  Image front;  ///< 3 channels
  Image back;
  int size() const { return front.width; }
};

/// The unit direction of a point of a map; t = 2 * texture coordinate - 1, beyond |t| = 1 past the equator.
Vec3 direction_of_map(const Vec2& t, bool back);

/// The point t of the map a unit direction falls on, w.xy / (1 + |w.z|).
Vec2 map_of_direction(const Vec3& w);

/// The direction of the centre of a texel, row 0 on top.
Vec3 direction_of_texel(int x, int y, int size, bool back);

/// A map of `size` texels across with `colour` of each texel's direction.
SphereMap make_sphere_map(int size, const std::function<Vec3(const Vec3& direction)>& colour);

/// Bilinear lookup.
Vec3 sample(const SphereMap& map, const Vec3& direction);

/// A sphere map and ever smaller, ever more blurred copies of it, level by level half the size (rounded
/// down). Level i is level 0 blurred with a spherical filter of variance variances[i] (radians^2);
/// variances[0] is 0.
struct PrefilteredMap {
  std::vector<SphereMap> levels;
  std::vector<double> variances;
};

/// The level of detail whose linear mix of two levels is a blur by `variance`: mixing two zero-mean filters
/// mixes their variances, so interpolation is linear in variance. Clamped to the last level.
double level_of_variance(const std::vector<double>& variances, double variance);

/// Lookup blurred by `variance`.
Vec3 sample(const PrefilteredMap& map, const Vec3& direction, double variance);

}  // namespace sateen::matcap
