// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// The second pass over the pictures: rectifies every used frame of `result`, whose camera, sphere, axis and
/// frames are known. Sets the result's preview and what is clipped; warns in it.
RectifiedStack collect_stack(FrameSource& source, const FirstLook& look, const StillMask& still,
                             const CaptureOptions& options, const Progress& progress, CaptureResult& result);

}  // namespace sateen::capture
