// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::capture {

/// Fills the texels of square RGB slices that nobody saw: those of the disc as smoothly as the known texels
/// around them allow, then those beyond it from the rim, so that no filter sees an edge. `seen` has an entry
/// for each slice and texel, 0 for the unseen.
void fill_unseen(std::vector<Image>& slices, const std::vector<std::uint8_t>& seen);

}  // namespace sateen::capture
