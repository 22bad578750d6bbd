// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/capture/sphere/sphere_view.h"

namespace sateen::capture {

struct FirstLook;
struct FrameAngles;

/// How the sphere sits on its stand.
struct Mounting {
  SphereView sphere;           ///< mean over the turn
  double radius = 0;           ///< SphereView::radius_pixel, the same in all frames
  double wobble = 0;           ///< pixels: radius of the circle the sphere's centre describes
  double wobble_rms = 0;       ///< pixels: what is left after that circle
  bool strays = false;         ///< that is too much: each frame was measured alone
  double outline_support = 0;  ///< share of the outline that stands out against the background
};

/// Where the first pass sees a frame's sphere.
struct SeenOutline {
  Vec2 centre{0, 0};   ///< SphereView::centre_pixel, pixels
  double support = 0;  ///< share of the outline that is seen
};

/// How the sphere sits, and its centre (pixels) in every frame.
struct FrameCentres {
  Mounting mounting;
  std::vector<Vec2> centres;
};

/// The used frames' centres lie on the circle that a sphere not mounted centrically describes, where it keeps
/// to one.
FrameCentres find_mounting(const std::vector<SeenOutline>& seen, const FirstLook& look,
                           const FrameAngles& angles);

/// What to do about the stand and the background, in plain words.
std::vector<std::string> advice(const Mounting& mounting);

}  // namespace sateen::capture
