// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// CaptureFrame::dropped of a frame that turned by next to nothing.
inline constexpr const char* kSameAngle = "shows the same angle as the frame before";

/// Places of the frames that are not dropped, ascending.
std::vector<std::size_t> used_frames(const std::vector<CaptureFrame>& frames);

/// Sets every frame's sharpness and drops those that have clearly less detail than the frames around them.
void drop_blurred(const std::vector<FrameNotes>& notes, std::vector<CaptureFrame>& frames);

/// Drops frames turned by next to nothing since the frame before.
void drop_duplicates(std::vector<CaptureFrame>& frames);

}  // namespace sateen::capture
