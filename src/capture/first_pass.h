// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/capture/exposure/still_points.h"
#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/sphere/first_look.h"
#include "sateen/capture/sphere/still_mask.h"
#include "sateen/capture/turning/mounting.h"
#include "sateen/capture/turning/surface_patch.h"
#include "sateen/core/progress.h"

namespace sateen::capture {

/// What the first pass over the pictures notes of a frame.
struct FrameNotes {
  bool read = false;  ///< false: a damaged video ended before it
  SeenOutline outline;
  SurfacePatch patch;
  std::vector<Vec3f> still;  ///< sample_still_points
};

/// Of every frame that can be read, in order: a damaged video ends early. `axes` as in PatchMap; `stand` as
/// find_stand finds it.
std::vector<FrameNotes> first_pass(FrameSource& source, const FirstLook& look, const StillMask& stand,
                                   const StillPoints& points, const Mat3& axes, const Progress& progress);

}  // namespace sateen::capture
