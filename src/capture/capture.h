// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sateen/capture/exposure/mirror_ball_shot.h"
#include "sateen/capture/exposure/photometry.h"
#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/sphere/lens.h"
#include "sateen/capture/table/clipping.h"
#include "sateen/capture/table/first_angle.h"
#include "sateen/capture/table/frame.h"
#include "sateen/capture/table/make_table.h"
#include "sateen/capture/table/seams.h"
#include "sateen/capture/turning/mounting.h"
#include "sateen/capture/turning/turn.h"
#include "sateen/core/image.h"
#include "sateen/core/progress.h"

namespace sateen::capture {

/// What each stage is asked for.
struct CaptureOptions {
  FrameSourceOptions source;
  LensOptions lens;
  TurnOptions turn;
  TangentOptions tangent;
  SeamOptions seams;
  TableOptions table;
  MirrorBallOptions mirror_ball;
  Progress progress;
};

/// What each stage found.
struct CaptureResult {
  CaptureTable table;
  Lens lens;
  Turn turn;
  Mounting mounting;
  Photometry photometry;
  Clipping clipping;
  Seams seams;
  FirstAngle first_angle;
  std::vector<CaptureFrame> frames;
  int preview_frame = 0;  ///< the first used frame
  Image preview;          ///< its light, as preview_of gives it
  Image environment;      ///< from the mirror ball, latitude-longitude (light/environment.h); empty: none
  std::vector<std::string> warnings;  ///< in plain words with what to do
};

/// From photographs or a video of a turning sphere to an Anisotropic MatCap (Magri et al., section 5).
/// Decodes everything twice, keeps a few frames in memory. Throws Error, in plain words, for what a user can
/// get wrong.
CaptureResult build_capture(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options);

}  // namespace sateen::capture
