// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sateen/capture/photographs/photograph.h"

namespace sateen::capture {

/// A grey picture for finding things: 255 sqrt(light), so that sensor noise is about the same everywhere,
/// scaled down by a whole factor so that its long side is at most about 1280 pixels.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> codes;

  std::uint8_t at(int x, int y) const { return codes[pixel_index(x, y, width)]; }
};

/// The light of every code, in [0, 1].
template <typename Real>
inline constexpr std::array<Real, 256> kLightOfCode = [] {
  std::array<Real, 256> light{};
  for (std::size_t code = 0; code < light.size(); ++code)
    light[code] = static_cast<Real>(code * code) / static_cast<Real>(255 * 255);
  return light;
}();

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

}  // namespace sateen::capture
