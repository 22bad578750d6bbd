// SPDX-License-Identifier: MIT
#include "sateen/appearance/appearance.h"

namespace sateen::appearance {

ParameterValue Appearance::get(const std::string& name) const {
  unknown_parameter(name, parameters());
}

void Appearance::set(const std::string& name, const ParameterValue&) {
  unknown_parameter(name, parameters());
}

// shaders/light/lit.glsl has the same loop.
Vec3 Reflectance::radiance(const Surface& surface, const light::Lighting& lighting,
                           const Visibility& visible) const {
  const std::unique_ptr<Point> point = at(surface);
  Vec3 sum = surface.occlusion * point->surroundings(lighting.surroundings);
  for (std::size_t i = 0; i < lighting.lamps.size(); ++i) {
    const double share = visible ? visible(i, surface) : 1;
    if (share <= 0) continue;
    const light::ArrivingLight arriving = light::arriving_light(lighting.lamps[i], surface.position);
    sum += share * arriving.irradiance.cwiseProduct(point->lit(arriving.direction));
  }
  return sum.cwiseMax(0);
}

}  // namespace sateen::appearance
