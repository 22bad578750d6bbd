// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "sateen/core/vector.h"

namespace sateen::matcap {

/// The colours of the blind spot of a sphere map: a cap around -z no visible point looks at (Zubiaga et al.
/// 2015, section 4.2). They solve Poisson's equation in the plane of the back map, where the cap is a disc,
/// with the colours on its boundary given and the divergence of a radial guiding gradient on the right: the
/// slope with which the colours arrive at the boundary, fading to nothing towards the centre. The solution is
/// smooth in all directions; what varies fast along the boundary dies out quickly inwards, so that no streaks
/// run to the centre.
class BlindSpot {
 public:
  /// `colour` gives the colour at angle `beyond` (radians, >= 0) from the edge of the cap of angular radius
  /// `angle`, at azimuth `azimuth` (radians, from x to y); it is asked close to the edge only.
  BlindSpot(double angle, const std::function<Vec3(double beyond, double azimuth)>& colour);

  /// The colour in a unit direction within the cap, never negative.
  Vec3 operator()(const Vec3& direction) const;

 private:
  double radius_ = 0;  // of the disc in the back map
  Eigen::MatrixXd
      colours_;  // 3 x (1 + rings * spokes): the centre, then ring by ring outwards, the boundary last
};

}  // namespace sateen::matcap
