// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// Sets every frame's gain from what stands still in the pictures (`height` pixels high); warns of drift,
/// flicker and banding. Uses up the notes' still points.
Photometry find_frame_light(std::vector<FrameNotes>& notes, const FirstLook& look, int height,
                            std::vector<CaptureFrame>& frames, std::vector<std::string>& warnings);

}  // namespace sateen::capture
