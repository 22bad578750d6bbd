// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::capture {

/// Pixels that do not show the sphere though they lie inside its outline: a stand in front.
struct StillMask {
  int width = 0;  ///< 0: none
  int height = 0;
  int factor = 1;                   ///< picture pixels per pixel of the mask
  std::vector<std::uint8_t> still;  ///< 1: stands still

  bool hides(float x, float y) const {
    const auto u = static_cast<int>(x) / factor;
    const auto v = static_cast<int>(y) / factor;
    return u >= 0 && v >= 0 && u < width && v < height && still[pixel_index(u, v, width)] != 0;
  }
};

}  // namespace sateen::capture
