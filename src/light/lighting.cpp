// SPDX-License-Identifier: MIT
#include "sateen/light/lighting.h"

#include <cmath>

namespace sateen::light {

Vec3 Surroundings::radiance(const Vec3& direction, double alpha) const {
  return environment ? environment->radiance(environment_from_view * direction, alpha) : Vec3::Zero();
}

Surroundings make_surroundings(const Image& latitude_longitude) {
  int width = 64;
  while (width < latitude_longitude.width && width < 512) width *= 2;
  Surroundings result;
  result.environment = std::make_shared<const PrefilteredEnvironment>(latitude_longitude, width);
  result.harmonics = project_environment(latitude_longitude);
  return result;
}

Surroundings even_surroundings(const Vec3& radiance) {
  Surroundings result;
  result.harmonics.c[0] = radiance;
  return result;
}

Surroundings turned(const Surroundings& surroundings, const Mat3& rotation) {
  Surroundings result = surroundings;
  result.environment_from_view = surroundings.environment_from_view * rotation.transpose();
  result.harmonics = rotated(surroundings.harmonics, rotation);
  return result;
}

Mat3 turn_about_vertical(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
}

}  // namespace sateen::light
