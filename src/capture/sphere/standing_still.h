// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/measure.h"
#include "sateen/capture/sphere/still_mask.h"

namespace sateen::capture {

/// A stand in front of the sphere does not turn: where it reaches in from the outline, the picture is no more
/// active than the background. Warns of it. Empty when nothing stands in front.
StillMask find_stand(const FirstLook& look, std::vector<std::string>& warnings);

}  // namespace sateen::capture
