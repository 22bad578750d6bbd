// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/sphere/camera.h"

namespace sateen::capture {

/// What is known of a focal length that nobody told, pixels.
struct FocalEstimate {
  double focal = 0;       ///< the most probable
  double low = 0;         ///< 95 % of the probability lie between
  double high = 0;        ///< these two
  bool informed = false;  ///< false: the outline says next to nothing, this is what cameras commonly have

  FocalEstimate scaled(double factor) const {
    return {focal * factor, low * factor, high * factor, informed};
  }
};

/// Standard deviation of the prior, in natural log of the focal length, about the one that is assumed: from a
/// wide phone to a short telephoto lens two out of three cameras lie within 38 and 87 degrees, horizontal.
inline constexpr double kFocalPrior = 0.5;

/// A sphere beside the picture's middle is seen as an ellipse, the more so the shorter the focal length: its
/// axes are as 1 : 1 / cos of the angle from the camera's axis. So the outline's points (pixels; at least a
/// few dozen, some may be wrong) tell the focal length, together with a log-normal prior about that of
/// `assumed` (maximum a posteriori). A sphere in the middle leaves the prior as it is. The noise is taken
/// from the points' own distances to the best outline, neighbours counted as far as they are independent; the
/// interval allows for a lens that distorts a little.
FocalEstimate estimate_focal(std::span<const Vec2> outline, const Camera& assumed);

/// What a focal length of `real` instead of `focal` pixels does, degrees, half-way between the middle and the
/// rim of a sphere of `radius` (SphereView::radius_pixel).
struct LensEffect {
  double normals = 0;
  double tangents = 0;
};
LensEffect lens_effect(double radius, double focal, double real);

}  // namespace sateen::capture
