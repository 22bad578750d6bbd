// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/table/frame.h"
#include "sateen/capture/table/stack.h"
#include "sateen/core/progress.h"

namespace sateen::capture {

/// The second pass over the pictures: rectifies every frame that is used, all with `map`. `axis` is the
/// turning's.
RectifiedStack collect_stack(FrameSource& source, const RectifyMap& map, std::span<const CaptureFrame> frames,
                             const Vec3& axis, const Progress& progress);

}  // namespace sateen::capture
