// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/sphere/first_look.h"
#include "sateen/capture/sphere/still_mask.h"

namespace sateen::capture {

/// What stands in front of the sphere and does not turn.
struct StandInFront {
  StillMask mask;    ///< empty when nothing stands in front
  double share = 0;  ///< of the sphere's picture that hardly changes
};

/// A stand in front of the sphere does not turn: where it reaches in from the outline, the picture is no more
/// active than the background. Where that is too much of the sphere to be a stand nothing is masked.
StandInFront find_stand(const FirstLook& look);

/// What to do about it, in plain words.
std::vector<std::string> advice(const StandInFront& stand);

}  // namespace sateen::capture
