// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// How the sphere turned over all frames.
struct FrameAngles {
  Vec3 axis{0, 0, 1};        ///< view space, unit, towards the camera
  bool equal_steps = false;  ///< given, or recognised and then used exactly
  double turned = 0;         ///< radians from the first to the last used frame
  double contradiction = 0;  ///< Turning::contradiction
  double known_off = 0;      ///< Turning::known_off
  double reversed_off = 0;   ///< Turning::reversed_off
};

/// Sets every frame's `turned` (0 for the first used frame) and `confidence`, and drops frames that turn out
/// blurred, repeated or not to be registered. Uses up the notes' patches. `axes` as in PatchMap;
/// `stride` as in FrameSource. Throws Error when too few frames are left, the surface shows too little to be
/// followed, or other than one angle a frame is given.
FrameAngles find_frame_angles(std::vector<FrameNotes>& notes, const Mat3& axes, const CaptureOptions& options,
                              int stride, std::vector<CaptureFrame>& frames);

/// Throws Error unless the used frames go all the way round; warns of wide gaps and of angles that contradict
/// each other.
void check_turn(const std::vector<CaptureFrame>& frames, const FrameAngles& turn,
                const CaptureOptions& options, std::vector<std::string>& warnings);

}  // namespace sateen::capture
