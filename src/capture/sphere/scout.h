// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sateen/capture/photographs/photograph.h"
#include "sateen/core/vector.h"

namespace sateen::capture {

/// A grey picture for finding things: 255 sqrt(light), so that sensor noise is about the same everywhere,
/// scaled down by a whole factor so that its long side is at most about 1280 pixels.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> codes;

  std::uint8_t at(int x, int y) const { return codes[pixel_index(x, y, width)]; }
};

int grey_factor(int width, int height);

/// A rectangle of the grey picture, first column and row included, last not.
struct GreyRegion {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

GreyPicture grey_picture(const Photograph& frame, int factor);

/// Only `region`, into a picture that is there: what lies outside of it, 0 at first, stays as it is.
void grey_picture(const Photograph& frame, int factor, const GreyRegion& region, GreyPicture& picture);

/// What a few frames of a capture, spread over the turn, say of where the turning sphere is. In pixels of
/// GreyPicture.
struct Scouting {
  Vec2 centre{0, 0};
  double radius = 0;
  std::vector<float> gain;      ///< per frame, of the codes, relative to the median frame
  std::vector<float> activity;  ///< per pixel: standard deviation over time, in codes, gains removed
  std::vector<float> mean;      ///< per pixel, codes
  double noise = 0;             ///< codes, of a pixel that stands still
  double moved = 0;             ///< pixels the background moved between the first and last frames
};

/// Finds the sphere: the background stands still, its surface turns. Robust against dark or plain parts of
/// the sphere, small moving things beside it, exposure drift; to about a pixel (the outline fit refines it).
/// Throws Error in plain words when nothing round turns, two things do, the sphere is cut by the picture's
/// edge, or the camera moved; `factor`: pixels of the photographs to one of `frames`, for what it says.
Scouting find_sphere(std::span<const GreyPicture> frames, int factor);

}  // namespace sateen::capture
