// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// What of the turning body shows no clean material: the painted mask, when there is one (throws Error when
/// it does not fit the frames), and the blemishes found without a hint. Warns in `result` when the latter are
/// too many to be seams.
SurfaceMask find_seams(const RectifiedStack& stack, const CaptureOptions& options, CaptureResult& result);

}  // namespace sateen::capture
