// SPDX-License-Identifier: MIT
#include "sateen/matcap/warp.h"

#include <algorithm>
#include <cmath>

namespace sateen::matcap {
namespace {

/// `v` with its angle to +z multiplied by `factor`; +z stays, -z goes around +x.
Vec3 scale_angle(const Vec3& v, double factor) {
  const double across = std::hypot(v.x(), v.y());
  const double angle = factor * std::atan2(across, v.z());
  const Vec2 azimuth = across > 0 ? Vec2(v.x() / across, v.y() / across) : Vec2(1, 0);
  return {std::sin(angle) * azimuth.x(), std::sin(angle) * azimuth.y(), std::cos(angle)};
}

}  // namespace

double slope_of_variance(double nu) {
  return std::clamp(1 - 0.3 * nu - 1.1 * nu * nu, 0.0, 1.0);
}

Vec3 warp(const Vec3& n, double mu) {
  return scale_angle(n, 1 + mu);
}

Vec3 unwarp(const Vec3& w, double mu) {
  return scale_angle(w, 1 / (1 + mu));
}

double blind_spot_angle(double mu) {
  return (1 - mu) * kPi / 2;
}

}  // namespace sateen::matcap
