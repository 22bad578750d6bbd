// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sateen/capture/scout.h"
#include "sateen/capture/sphere_view.h"

namespace sateen {

/// The sphere's fine surface detail in one frame, on a disc of the normals in a frame fixed to the camera (z
/// from the mean sphere's centre to the eye): pixel (x, y), row 0 on top, shows the normal whose disc point
/// is kPatchReach * disc_of_pixel(x, y, size). Light relative to its neighbourhood, 127 per unit, 0 outside
/// the disc.
struct SurfacePatch {
  int size = 0;
  std::vector<std::int8_t> detail;
  double sharpness = 0;  ///< rms of the detail: blurred frames have less
};

inline constexpr double kPatchReach = 0.9;

/// `axes` is the rotation from view space to the patch's frame.
SurfacePatch surface_patch(const GreyPicture& frame, const Camera& camera, const SphereView& sphere,
                           const Mat3& axes, int size);

/// How a capture's sphere turned.
struct Turning {
  Vec3 axis{0, 0, 1};  ///< view space, unit, towards the camera; angles are counter-clockwise about it
  std::vector<double> angles;      ///< per patch, radians, the first is 0; not unwrapped, in [0, 2 pi)
  std::vector<double> confidence;  ///< per patch: correlation with the common surface, 1 is perfect
  std::vector<double>
      strength;  ///< per patch: how much of the common surface's detail it shows; blurred ones less
  double confidence_floor = 0;  ///< correlation that chance alone reaches
  double step_error = 0;        ///< radians, rms of the last refinement
  double contradiction = 0;     ///< radians: PolarPictures::contradiction
};

/// Finds every frame's angle by registering it with the surface all frames have in common, first about the
/// middle of the disc and, where neighbouring frames turn about another axis, about that; then with the axis
/// free: each frame's small rotation is solved for (Lucas-Kanade on the sphere), the axis explains what they
/// share. `axes` as in surface_patch.
Turning find_turning(std::span<const SurfacePatch> patches, const Mat3& axes);

/// The axis alone, when the angles (radians) are known from the stage; corrects each by what the pictures say
/// if `refine_angles`.
Turning find_axis(std::span<const SurfacePatch> patches, const Mat3& axes, std::span<const double> angles,
                  bool refine_angles);

}  // namespace sateen
