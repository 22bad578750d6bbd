// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::brdf {

/// The integral of `f` over [a, b] by adaptive Gauss-Kronrod (7, 15) bisection until the estimated error of
/// every piece is below its share of `tolerance` (absolute), or a piece has been halved `max_depth` times.
double integrate(const std::function<double(double)>& f, double a, double b, double tolerance = 1e-9,
                 int max_depth = 24);

/// Nodes and weights of the n-point Gauss-Legendre rule on [0, 1].
struct GaussRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};
const GaussRule& gauss_rule(int n);

/// One direction of a cubature on the sphere; the weights (solid angles, sr) sum to the covered solid angle.
struct SphereNode {
  Vec3 direction;
  double weight = 0;
};

/// The integral of `f` over the upper hemisphere (z > 0) in polar coordinates about `axis` (unit), adaptively
/// in both angles. Made for functions that change fast across cones about the axis, as light scattered by a
/// fibre does; `cones` are the angles from the axis (radians) where they do.
double integrate_hemisphere(const std::function<double(const Vec3&)>& f, const Vec3& axis,
                            std::span<const double> cones, double tolerance = 1e-8);

/// The fixed-order sibling of integrate_hemisphere for functions with several values: the same coordinates,
/// `order` Gauss nodes between neighbouring cones and along each circle.
std::vector<SphereNode> hemisphere_nodes(const Vec3& axis, std::span<const double> cones, int order);

}  // namespace sateen::brdf
