// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// Which frames were left out and why. Repeated ones are nothing to tell: a turn by hand has many.
std::vector<std::string> dropped_advice(const std::vector<CaptureFrame>& frames);

/// What the focal length's interval (CaptureResult::focal, which there has to be) may cost.
LensEffect focal_effect(const CaptureResult& result);

/// What to do better about framing, lens and axis, in plain words; `texels` is the table's size.
std::vector<std::string> framing_advice(const CaptureResult& result, int texels);

}  // namespace sateen::capture
