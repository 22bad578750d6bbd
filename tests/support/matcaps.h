// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "sateen/core/direction.h"
#include "sateen/core/image.h"
#include "sateen/io/image.h"
#include "sateen/matcap/sphere_disc.h"
#include "support/files.h"

namespace sateen::test {

inline constexpr std::array<const char*, 5> kMatcaps{"carpaint", "ceramic", "jade", "lead", "resin"};

/// A shipped MatCap, shrunk.
inline Image example_matcap(const std::string& name, int size) {
  return resized(io::read_image(examples() / "matcaps" / (name + ".exr")), size, size);
}

/// The picture of a sphere that fills it, with `colour` of the unit normal; black off the sphere.
inline Image sphere_picture(int size, const std::function<Vec3(const Vec3& normal)>& colour) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 p = disc_of_pixel(x, y, size);
      if (p.squaredNorm() < 1) image.set_rgb(x, y, colour(normal_on_disc(p)).cast<float>());
    }
  }
  return image;
}

inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The direction at angles from the view axis and, counter-clockwise, from x.
inline Vec3 direction_at(double theta, double azimuth) {
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
}

}  // namespace sateen::test
