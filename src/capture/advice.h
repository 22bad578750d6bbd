// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/capture.h"

namespace sateen {

/// What to do better about framing, lens and axis, in plain words; `texels` is the table's size.
std::vector<std::string> framing_advice(const CaptureResult& result, int texels);

}  // namespace sateen
