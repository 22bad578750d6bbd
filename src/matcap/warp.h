// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::matcap {

/// Slope of a material filter of variance `nu` (radians^2): mu = 1 - 0.3 nu - 1.1 nu^2 (Zubiaga et al. 2015,
/// section 3.1), kept in [0, 1]. 1 looks at the mirror direction, 0 along the normal.
double slope_of_variance(double nu);

/// The direction in which a component looks from a point with unit normal `n`, n.z >= 0: n turned away from
/// the view axis e2 = (0, 0, 1), about e2 x n, by mu times its angle theta to it (section 5). So theta
/// becomes (1 + mu) theta.
Vec3 warp(const Vec3& n, double mu);

/// The inverse (section 4.2): the normal that looks in direction `w`. Its angle to the view axis exceeds
/// pi/2, and no visible point has it, for directions in the blind spot around -z.
Vec3 unwarp(const Vec3& w, double mu);

/// Angle from -z within which no visible point looks: (1 - mu) pi/2.
double blind_spot_angle(double mu);

}  // namespace sateen::matcap
