// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// What the focal length's interval (Lens::estimate, which there has to be) may cost.
LensEffect focal_effect(const CaptureResult& result);

/// What to do better, in plain words, from all that the stages found: their own advice, which frames were
/// left out and why (repeated ones are nothing to tell: a turn by hand has many), framing, lens and axis.
std::vector<std::string> advice(const CaptureResult& result);

}  // namespace sateen::capture
