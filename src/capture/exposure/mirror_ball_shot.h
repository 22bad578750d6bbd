// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "sateen/capture/photographs/frame_source.h"
#include "sateen/core/image.h"

namespace sateen::capture {

struct FirstLook;

struct MirrorBallOptions {
  std::filesystem::path picture;  ///< of a chrome ball on the same stand; empty: none
  double reflectance = 0.6;       ///< of chrome
};

/// The light around the stand (as mirror_ball_environment gives it) from the picture of a chrome ball that
/// stands where the sphere stood, perhaps a little larger or smaller. Throws Error when the picture is of
/// another size than the frames or shows no ball there.
Image mirror_ball_shot(const MirrorBallOptions& options, const FrameSourceOptions& source,
                       const FirstLook& look);

}  // namespace sateen::capture
