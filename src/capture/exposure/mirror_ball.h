// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/photographs/photograph.h"
#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/core/image.h"

namespace sateen::capture {

/// The light around a chrome ball from one picture of it, as a latitude-longitude map `width` x width / 2:
/// column u is the longitude 2 pi (u / width - 1/2) counted from -z (straight ahead of the camera) towards
/// +x, row 0 is up (+y). View space. Directions that only the ball's very rim shows (behind it, some 20
/// degrees around) go on smoothly from their neighbours. `reflectance` is the ball's.
Image mirror_ball_environment(const Photograph& frame, const Camera& camera, const SphereView& ball,
                              int width, double reflectance);

/// The surface normal of a mirror ball at which the direction `towards` (unit, far away) is reflected into
/// the eye.
Vec3 mirror_normal(const SphereView& ball, const Vec3& towards);

}  // namespace sateen::capture
