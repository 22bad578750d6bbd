// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/core/image.h"

namespace sateen::capture {

struct RectifiedStack;

/// Seams, folds and cuts: the part of the turning body that shows no clean material. A size x size picture
/// (row 0 on top) of the body at angle 0 along the axis: pixel (x, y) is the body_point disc_of_pixel(x, y,
/// size).
struct SurfaceMask {
  int size = 0;
  std::vector<std::uint8_t> masked;    ///< 1: shows no clean material
  std::vector<std::uint8_t> excluded;  ///< masked and its near neighbours, whose footprints overlap it
  std::vector<float> deviation;  ///< how much lighter (+) or darker (-) than its neighbours, natural log
  double share = 0;              ///< of the disc

  /// Whether a sample of this body point must not be used.
  bool excludes(const Vec2& body) const;
  /// Whether the body point itself shows no clean material.
  bool masks(const Vec2& body) const;
};

/// Finds blemishes with no hint: along the turn each texel's light changes smoothly, except while a seam
/// passes. What deviates from the median of the angles around it, at the same place of the body in all
/// frames, is a blemish; shading is not, as it stands still while the body turns. `already` (may be empty) is
/// left out of the medians.
SurfaceMask find_blemishes(const RectifiedStack& stack, const SurfaceMask& already);

/// A mask painted on one frame (white: not material; pictures of the frame's size), carried to the body:
/// `angle` is that frame's. Throws nothing; the caller checks sizes.
SurfaceMask mask_from_painting(const Image& painting, const Camera& camera, const SphereView& sphere,
                               const Vec3& axis, double angle, int size);

/// Both together.
SurfaceMask united(const SurfaceMask& a, const SurfaceMask& b);

/// Direction (radians, counter-clockwise in the picture plane at angle 0) in which the masked part lies from
/// the middle, if it lies clearly to one side: false otherwise.
bool mask_direction(const SurfaceMask& mask, double& direction);

}  // namespace sateen::capture
