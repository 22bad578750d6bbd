// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace sateen::amc {

/// A frame's index and its share in a resampled value; shares sum to 1.
using FrameWeights = std::vector<std::pair<int, double>>;

/// How to make the value at `angle` (turns, cyclic) from frames at ascending `angles` in [0, 1), for slices
/// `spacing` turns apart: cubic (Catmull-Rom on uneven knots) where frames are as sparse as slices or
/// sparser, a tent as wide as the spacing where they are denser, so that nothing aliases. A frame at exactly
/// `angle` is taken alone if frames are no denser than slices.
FrameWeights cyclic_weights(std::span<const double> angles, double angle, double spacing);

}  // namespace sateen::amc
