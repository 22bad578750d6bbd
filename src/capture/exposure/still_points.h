// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/capture/photographs/photograph.h"
#include "sateen/capture/sphere/first_look.h"

namespace sateen::capture {

/// Where the picture stands still.
struct StillPoints {
  std::vector<Eigen::Vector2i> pixels;  ///< of the photographs
  std::vector<double> grey;             ///< mean light of each, grey
};

/// Up to a thousand points, spread evenly, clear of the sphere, whose grey pixel neither changes nor is
/// nearly black or clipped.
StillPoints still_points(const FirstLook& look);

/// The light at each still point of a frame, mean over 3 x 3 pixels; negative where clipped.
std::vector<Vec3f> sample_still_points(const StillPoints& points, const Photograph& frame);

/// Mean green light of a frame's samples; clipped ones count as white, and none at all as well.
double mean_light(const std::vector<Vec3f>& samples);

/// Gain of a frame's grey codes from its samples: the median ratio, as a square root like the codes.
double code_gain(const StillPoints& points, const std::vector<Vec3f>& samples);

}  // namespace sateen::capture
