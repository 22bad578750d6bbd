// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/turning/surface_patch.h"

namespace sateen::capture {

/// How a capture's sphere turned.
struct Turning {
  Vec3 axis{0, 0, 1};  ///< view space, unit, towards the camera; angles are counter-clockwise about it
  std::vector<double> angles;      ///< per patch, radians, the first is 0; not unwrapped, in [0, 2 pi)
  std::vector<double> confidence;  ///< per patch: correlation with the common surface, 1 is perfect
  std::vector<double>
      strength;  ///< per patch: how much of the common surface's detail it shows; blurred ones less
  double confidence_floor = 0;  ///< correlation that chance alone reaches
  double contradiction = 0;     ///< radians: PolarPictures::contradiction
  /// Of angles that were known: the median difference to what registration finds by itself, radians, as they
  /// are and with their direction reversed. 0 where the surface shows too little to tell.
  double known_off = 0;
  double reversed_off = 0;
};

/// Finds every frame's angle by registering it with the surface all frames have in common, first about the
/// middle of the disc and, where neighbouring frames turn about another axis, about that; then with the axis
/// free: each frame's small rotation is solved for (Lucas-Kanade on the sphere), the axis explains what they
/// share. `axes` as in PatchMap.
Turning find_turning(std::span<const SurfacePatch> patches, const Mat3& axes);

/// The axis alone, when the angles (radians) are known from the stage.
Turning find_axis(std::span<const SurfacePatch> patches, const Mat3& axes, std::span<const double> angles);

}  // namespace sateen::capture
