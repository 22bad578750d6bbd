// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// The tangent's picture-plane angle (radians) in the middle of the disc at angle 0, as the options say where
/// to take it from; sets `result.zero_source` and warns when nothing fixes it. Throws Error when seam or
/// weave are asked for and not to be seen.
double find_first_angle(const RectifiedStack& stack, const CaptureOptions& options, CaptureResult& result);

}  // namespace sateen::capture
