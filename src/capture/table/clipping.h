// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::capture {

struct RectifiedStack;

/// What the camera could not tell from white.
struct Clipping {
  double share = 0;  ///< of all samples
  Image picture;     ///< as wide as a slice, 1 channel: share of the frames in which a texel is clipped
};

Clipping count_clipped(const RectifiedStack& stack);

/// What to do about it, in plain words.
std::vector<std::string> advice(const Clipping& clipping);

}  // namespace sateen::capture
