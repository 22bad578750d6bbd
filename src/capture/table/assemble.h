// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sateen/capture/table/stack.h"
#include "sateen/capture/table/surface_mask.h"
#include "sateen/core/image.h"

namespace sateen::capture {

/// Slices of a table at evenly spaced tangent angles over one period.
struct AssembledSlices {
  std::vector<Image> slices;       ///< RGB, row 0 on top; slice f is the angle f / (symmetry * count) turns
  std::vector<std::uint8_t> seen;  ///< per slice and texel: 1 measured, 2 blended across a gap along k, 0
                                   ///< filled from neighbouring texels
  double seen_share = 0;           ///< of the texels inside the disc
};

/// Every texel's samples, each at its own tangent angle (perspective and a tilted axis make them differ over
/// the disc), are folded into one period of 1 / symmetry of a turn and fitted by a local quadratic around
/// each slice's angle (Savitzky-Golay on uneven points), as wide as the samples are sparse. Masked samples
/// take no part: with symmetry > 1 the equivalent slices fill in for them. What is left unseen, the rim and
/// the corners are grown from their neighbours. `first_angle` in radians as in TangentAngle::pole.
AssembledSlices assemble(const RectifiedStack& stack, const SurfaceMask& mask, double first_angle, int count,
                         int symmetry);

}  // namespace sateen::capture
