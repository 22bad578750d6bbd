// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// The light around the stand (as mirror_ball_environment gives it) from the picture of a chrome ball that
/// stands where the sphere stood, perhaps a little larger or smaller. Throws Error when the picture is of
/// another size than the frames or shows no ball there.
Image mirror_ball_shot(const CaptureOptions& options, const FirstLook& look, const Camera& camera);

}  // namespace sateen::capture
