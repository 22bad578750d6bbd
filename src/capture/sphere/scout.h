// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/photographs/grey_picture.h"
#include "sateen/core/vector.h"

namespace sateen::capture {

/// What a few frames of a capture, spread over the turn, say of where the turning sphere is. In pixels of
/// GreyPicture.
struct Scouting {
  int width = 0;  ///< of the pictures
  int height = 0;
  Vec2 centre{0, 0};
  double radius = 0;
  std::vector<float> gain;      ///< per frame, of the codes, relative to the median frame
  std::vector<float> activity;  ///< per pixel: standard deviation over time, in codes, gains removed
  std::vector<float> mean;      ///< per pixel, codes
  double noise = 0;             ///< codes, of a pixel that stands still
};

/// Finds the sphere: the background stands still, its surface turns. Robust against dark or plain parts of
/// the sphere, small moving things beside it, exposure drift; to about a pixel (the outline fit refines it).
/// Throws Error in plain words when nothing round turns, two things do, the sphere is cut by the picture's
/// edge, or the camera moved; `factor`: pixels of the photographs to one of `frames`, for what it says.
Scouting find_sphere(std::span<const GreyPicture> frames, int factor);

}  // namespace sateen::capture
