// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::capture {

/// Exposure and white balance of each used frame relative to the mean of the capture.
struct Photometry {
  std::vector<Vec3> gain;   ///< per used frame: light in the frame / light in the mean frame, R, G, B
  double drift = 0;         ///< largest |gain - 1| of green
  double colour_drift = 0;  ///< largest change of red or blue against green
  double banding =
      0;  ///< rms difference between upper and lower half's gains: a lamp flickering within a frame
  bool measured = false;  ///< false: too little stands still, all gains are 1
};

/// From the light of every frame (one entry each) at the same points that stand still, negative where
/// clipped: medians, so that passing shadows do not count. `points` are the points' pixels in pictures
/// `height` pixels high.
Photometry solve_photometry(std::span<const std::vector<Vec3f>> samples,
                            std::span<const Eigen::Vector2i> points, int height);

/// What to do about drift, flicker and banding, in plain words.
std::vector<std::string> advice(const Photometry& photometry);

}  // namespace sateen::capture
