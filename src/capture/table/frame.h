// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sateen/capture/turning/dropped.h"
#include "sateen/core/vector.h"

namespace sateen::capture {

/// What one frame turned out to be.
struct CaptureFrame {
  std::string file;
  double angle = 0;    ///< radians in [0, 2 pi): the tangent's picture-plane angle in the middle of the disc
  double turned = 0;   ///< radians since the first used frame, counter-clockwise, in [0, 2 pi)
  Vec2 centre{0, 0};   ///< SphereView::centre_pixel, pixels from the picture's top left corner
  double radius = 0;   ///< SphereView::radius_pixel
  Vec3 gain{1, 1, 1};  ///< light relative to the capture's mean, R, G, B
  double sharpness = 0;   ///< relative to the median frame
  double confidence = 0;  ///< of the registration
  Dropped dropped = Dropped::no;

  bool used() const { return dropped == Dropped::no; }
};

}  // namespace sateen::capture
