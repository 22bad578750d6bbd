// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/sphere/lens.h"

namespace sateen::capture {

/// The lens from the best source there is: calibration, field of view, focal length and sensor, EXIF, or the
/// assumption (FocalSource::assumed). Throws Error when the calibration is for pictures of another shape.
Lens choose_lens(const FrameSource& source, const LensOptions& options);

}  // namespace sateen::capture
