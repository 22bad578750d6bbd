// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sateen/capture/table/frame.h"

namespace sateen::capture {

struct RectifiedStack;
struct SurfaceMask;

/// What fixes the tangent's direction in the first frame.
enum class ZeroAngle {
  first_frame,  ///< TangentOptions::angle is the tangent's picture-plane angle in the first frame
  thread,       ///< it is that of TangentOptions::frame: read off the picture in the middle of the sphere
  seam,         ///< the tangent is that angle from the direction in which the seam lies, seen from the middle
  weave,        ///< the visible weave's own direction in the middle, plus that angle
};

struct TangentOptions {
  ZeroAngle from = ZeroAngle::first_frame;
  bool given = false;  ///< of ZeroAngle::first_frame: otherwise a warning says that the angle is arbitrary
  double angle = 0;    ///< radians, counter-clockwise with y up
  int frame = 0;       ///< only for ZeroAngle::thread
};

/// The tangent's direction and how it is known.
struct FirstAngle {
  double angle = 0;  ///< radians: in the picture plane, in the middle of the disc, at angle 0 of the turn
  ZeroAngle from = ZeroAngle::first_frame;
  bool given = false;  ///< TangentOptions::given
  double found = 0;    ///< radians: the direction of the seam or weave in the first frame
};

/// Throws Error when seam or weave are asked for and not to be seen, or the thread's frame is none.
FirstAngle find_first_angle(const RectifiedStack& stack, const SurfaceMask& mask,
                            std::span<const CaptureFrame> frames, const TangentOptions& options);

/// How it is known, in words, for reports.
std::string words(const FirstAngle& angle);

/// What to do when nothing fixes the tangent, in plain words.
std::vector<std::string> advice(const FirstAngle& angle);

}  // namespace sateen::capture
