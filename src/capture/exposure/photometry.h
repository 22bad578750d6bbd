// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sateen/capture/photographs/photograph.h"
#include "sateen/capture/sphere/scout.h"

namespace sateen::capture {

/// Where the picture stands still: pixels of the full-size frames, spread evenly.
struct StillPoints {
  std::vector<Eigen::Vector2i> pixels;
};

/// Up to `count` points clear of the sphere (centre and radius in grey pixels, `clearance` more) whose grey
/// pixel neither changes nor is nearly black or clipped. `factor` is grey_factor.
StillPoints still_points(const Scouting& scouting, int grey_width, int grey_height, int factor,
                         double clearance, std::size_t count = 1000);

/// The light at each still point of a frame, mean over 3 x 3 pixels; negative where clipped.
std::vector<Vec3f> sample_still_points(const StillPoints& points, const Photograph& frame);

/// Exposure and white balance of each frame relative to the mean of the capture.
struct Photometry {
  std::vector<Vec3> gain;   ///< per frame: light in the frame / light in the mean frame, R, G, B
  double drift = 0;         ///< largest |gain - 1| of green
  double colour_drift = 0;  ///< largest change of red or blue against green
  double banding =
      0;  ///< rms difference between upper and lower half's gains: a lamp flickering within a frame
  bool measured = false;  ///< false: too little stands still, all gains are 1
};

/// From sample_still_points of every frame (all of the same points): medians, so that passing shadows do not
/// count. `upper`: which points lie in the upper half of the picture.
Photometry solve_photometry(std::span<const std::vector<Vec3f>> samples, const StillPoints& points,
                            int height);

}  // namespace sateen::capture
