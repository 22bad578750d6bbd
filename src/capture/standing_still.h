// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/measure.h"
#include "sateen/capture/rectify.h"

namespace sateen {

/// A stand in front of the sphere does not turn: it is no more active than the background. Makes such texels
/// invisible in `points` (one for each texel of `map`) and warns of them.
void hide_what_stands_still(const RectifyMap& map, const FirstLook& look, std::vector<SeenPoint>& points,
                            std::vector<std::string>& warnings);

}  // namespace sateen
