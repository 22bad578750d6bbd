// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {

/// `map` blurred by a radially symmetric, nearly Gaussian filter on the sphere whose variance along each axis
/// of the tangent plane is `variance` (radians^2), as a map of `size` texels. The filter is (1 - d^2 /
/// d0^2)^4 of the chord d, zero beyond d0^2 = 12 variance: smooth, compact and free of exponentials; applied
/// twice it is a Gaussian for all that can be seen. Exact for constant maps. A variance of 0 only resamples.
SphereMap blurred(const SphereMap& map, double variance, int size);

/// Level 0 is `map`; the levels below have a blur of three quarters of a texel's width at the map's centre,
/// down to 4 texels.
PrefilteredMap prefilter(SphereMap map);

/// The blur by any variance: from the prefiltered level that is nearest below it, back at the size of level
/// 0.
SphereMap blurred(const PrefilteredMap& map, double variance);

}  // namespace sateen::matcap
