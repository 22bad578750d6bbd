// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "sateen/capture/capture.h"
#include "sateen/capture/sphere/focal_estimate.h"
#include "sateen/capture/sphere/outline.h"
#include "sateen/capture/sphere/still_mask.h"
#include "sateen/capture/turning/turning.h"

namespace sateen::capture {

/// What a first look at a few frames finds: where the sphere is, and what stands still. In grey pixels.
struct FirstLook {
  int factor = 1;                      ///< picture pixels per grey pixel
  Camera camera;                       ///< of the grey pictures
  std::optional<FocalEstimate> focal;  ///< where the camera's was only assumed; `camera` has it already
  Scouting scouting;
  OutlineFit outline;
  Vec2 centre{0, 0};               ///< mean of the scouts' centres
  double reach = 0;                ///< farthest scout centre from it
  StillPoints still;               ///< in picture pixels
  std::vector<double> still_grey;  ///< mean light of each still point, grey
};

FirstLook first_look(FrameSource& source, const Camera& camera, const Progress& progress);

/// What the first pass notes of every frame.
struct FrameNotes {
  bool read = false;  ///< false: a damaged video ended before it
  Vec2 centre{0, 0};  ///< grey pixels
  double support = 0;
  SurfacePatch patch;
  std::vector<Vec3f> still;
};

/// `axes` as in PatchMap; `still` as find_stand finds it.
std::vector<FrameNotes> measure_frames(FrameSource& source, const FirstLook& look, const StillMask& still,
                                       const Mat3& axes, const Progress& progress);

}  // namespace sateen::capture
