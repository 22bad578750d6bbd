// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/measure.h"

namespace sateen::capture {

/// How the sphere sits on its stand.
struct Rig {
  SphereView sphere;           ///< mean over the turn
  double wobble = 0;           ///< pixels: radius of the circle the sphere's centre describes
  double wobble_rms = 0;       ///< pixels: what is left after that circle
  double outline_support = 0;  ///< share of the outline that stands out against the background
};

/// Sets every frame's centre and radius from the notes (which are in the first look's grey pixels): on the
/// circle that a sphere not mounted centrically describes, where it keeps to one.
Rig find_rig(const std::vector<FrameNotes>& notes, const FirstLook& look, const Camera& camera,
             std::vector<CaptureFrame>& frames, std::vector<std::string>& warnings);

}  // namespace sateen::capture
