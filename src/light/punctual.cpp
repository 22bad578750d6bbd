// SPDX-License-Identifier: MIT
#include "sateen/light/punctual.h"

#include <algorithm>
#include <cmath>

namespace sateen::light {

ArrivingLight arriving_light(const PunctualLight& light, const Vec3& position) {
  if (light.kind == PunctualLight::Kind::directional) return {light.direction, light.colour};
  const Vec3 towards = light.position - position;
  const double squared = std::max(towards.squaredNorm(), 1e-12);
  const Vec3 direction = towards / std::sqrt(squared);
  double factor = 1 / squared;
  if (light.kind == PunctualLight::Kind::spot) {
    const double outer = std::cos(light.outer_cone);
    const double width = std::max(std::cos(light.inner_cone) - outer, 1e-4);
    const double inside = std::clamp((-direction.dot(light.direction) - outer) / width, 0.0, 1.0);
    factor *= inside * inside;
  }
  return {direction, light.colour * factor};
}

}  // namespace sateen::light
