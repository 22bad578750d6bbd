// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/turning/dropped.h"
#include "sateen/capture/turning/surface_patch.h"
#include "sateen/capture/turning/turn.h"

namespace sateen::capture {

/// The turn as a whole and frame by frame.
struct FrameAngles {
  Turn turn;
  std::vector<double> turned;      ///< per frame: radians in [0, 2 pi), 0 for the first used one
  std::vector<double> confidence;  ///< per frame: of the registration; 0 without one
  std::vector<Dropped> dropped;    ///< per frame: also what turned out blurred, repeated or without an angle
};

/// `patches` are of the frames that are used according to `dropped`, `axes` as in PatchMap, `stride` as in
/// FrameSource, `period` the radians after which the table repeats. Throws Error when too few frames are
/// left, the surface shows too little to be followed, other than one angle a frame is given, or the used
/// frames do not go all the way round.
FrameAngles find_frame_angles(std::span<const SurfacePatch> patches, std::vector<Dropped> dropped,
                              const Mat3& axes, const TurnOptions& options, int stride, double period);

}  // namespace sateen::capture
