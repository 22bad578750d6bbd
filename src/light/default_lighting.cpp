// SPDX-License-Identifier: MIT
#include "sateen/light/default_lighting.h"

#include <cmath>

#include "sateen/light/environment.h"

namespace sateen::light {
namespace {

PunctualLight lamp(const Vec3& towards, const Vec3& irradiance) {
  PunctualLight light;
  light.direction = towards.normalized();
  light.colour = irradiance;
  return light;
}

/// A soft box: brightest about `axis`, half as bright `width` radians from it.
double soft_box(const Vec3& direction, const Vec3& axis, double width) {
  const double sharpness = std::log(2) / (1 - std::cos(width));
  return std::exp(sharpness * (direction.dot(axis.normalized()) - 1));
}

/// A floor that sends a little back, walls, a bright ceiling; a soft box at each side, of which glossy
/// materials have something to reflect and whose grazing light shows a pile.
Vec3 sky_radiance(const Vec3& direction) {
  const Vec3 floor(0.155, 0.15, 0.145);
  const Vec3 ceiling(0.37, 0.39, 0.43);
  const double height = (1 + direction.y()) / 2;
  const double up = height * height * (3 - 2 * height);
  return floor + up * (ceiling - floor) +
         Vec3::Constant(1.4 * soft_box(direction, {-0.85, 0.35, -0.4}, 0.35) +
                        0.9 * soft_box(direction, {0.8, 0.4, -0.45}, 0.35));
}

}  // namespace

DefaultLighting default_lighting() {
  DefaultLighting lighting;
  lighting.lamps = {lamp({-0.52, 0.62, 0.7}, {3.5, 3.4, 3.24}), lamp({0.65, 0.5, -0.6}, {2.5, 2.56, 2.7})};
  lighting.sky = Image(128, 64, 3);
  for (int y = 0; y < lighting.sky.height; ++y) {
    for (int x = 0; x < lighting.sky.width; ++x) {
      const Vec2 uv((x + 0.5) / lighting.sky.width, (y + 0.5) / lighting.sky.height);
      lighting.sky.set_rgb(x, y, sky_radiance(environment_direction(uv)).cast<float>());
    }
  }
  return lighting;
}

}  // namespace sateen::light
