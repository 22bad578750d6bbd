// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::light {

/// A light without extent, in view space.
struct PunctualLight {
  enum class Kind {
    directional,  ///< from infinitely far
    point,        ///< falls off with the square of the distance
    spot,         ///< a point light within a cone, as glTF KHR_lights_punctual smooths it
  };
  Kind kind = Kind::directional;
  Vec3 direction{
      0, 0, 1};  ///< unit, *towards* a directional light; for a spot the way its axis points, from the light
  Vec3 position{0, 0, 0};  ///< of point and spot lights
  /// Directional: irradiance on a surface facing the light. Point, spot: radiant intensity, the same at
  /// distance 1.
  Vec3 colour{1, 1, 1};
  double inner_cone = 0;        ///< radians from the axis: full light inside
  double outer_cone = kPi / 4;  ///< radians: dark outside; greater than inner_cone
};

struct ArrivingLight {
  Vec3 direction;   ///< unit, towards the light
  Vec3 irradiance;  ///< on a surface facing the light
};

/// The light that arrives at a point in view space.
ArrivingLight arriving_light(const PunctualLight& light, const Vec3& position);

}  // namespace sateen::light
