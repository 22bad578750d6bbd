// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::capture {

/// The circle (an ellipse, when the axis is tilted) that a sphere not mounted centrically describes in the
/// picture.
struct Wobble {
  Vec2 middle{0, 0};
  Vec2 cosine{0, 0};
  Vec2 sine{0, 0};
  double rms = 0;  ///< pixels, of the centres' distance from it

  Vec2 at(double angle) const { return middle + std::cos(angle) * cosine + std::sin(angle) * sine; }
};

/// Robust fit to one centre (pixels) and angle (radians) a frame.
Wobble fit_wobble(const std::vector<Vec2>& centres, const std::vector<double>& angles);

}  // namespace sateen::capture
