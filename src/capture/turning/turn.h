// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::capture {

/// Where the frames' turning angles come from.
enum class AngleSource {
  pictures,  ///< registered from the pictures; equal steps are recognised
  equal,     ///< equal steps over one full turn, the direction as TurnOptions::clockwise says
  given,     ///< TurnOptions::angles, from the stage
};

struct TurnOptions {
  AngleSource source = AngleSource::pictures;
  std::vector<double> angles;  ///< radians, counter-clockwise, one for each frame
  bool clockwise = false;      ///< only for AngleSource::equal
};

inline constexpr int kFewestCaptureFrames = 12;

/// How the sphere turned over all frames.
struct Turn {
  Vec3 axis{0, 0, 1};        ///< view space, unit, towards the camera
  bool equal_steps = false;  ///< given, or recognised and then used exactly
  double turned = 0;         ///< radians from the first to the last used frame, counter-clockwise
  double widest_gap = 0;     ///< radians between neighbouring frames, where the table's period is wrapped up
  double even_gap = 0;       ///< radians, were all gaps alike
  double contradiction = 0;  ///< radians: how far parts of the sphere stray from the frames' angles, median
  double known_off = 0;      ///< radians: how far given angles are from those of the pictures, median
  double reversed_off = 0;   ///< radians: the same with the angles' direction reversed
};

/// What to do about gaps and about angles that contradict each other, in plain words.
std::vector<std::string> advice(const Turn& turn);

}  // namespace sateen::capture
