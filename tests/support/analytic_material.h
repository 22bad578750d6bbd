// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "sateen/amc/symmetry.h"
#include "sateen/amc/table.h"
#include "sateen/core/direction.h"

namespace sateen::test {

/// A material in closed form: two fibre-like lobes that turn with the tangent (k in turns) over a diffuse
/// part. It is unchanged by 1/symmetry of a turn (and no smaller turn) and at most a few harmonics rich;
/// colours lie in (0, 1).
inline Vec3 analytic_colour(const Vec3& n, double k, int symmetry) {
  const double angle = 2 * kPi * k * symmetry;
  const double diffuse = 0.25 + 0.15 * n.dot(Vec3(0.3, 0.5, 0.8));
  const double lobe = 0.5 + 0.5 * std::cos(angle - 2 * n.x() + n.y());
  const double second = 0.5 + 0.5 * std::sin(2 * angle + n.y());
  return {diffuse + 0.3 * lobe, diffuse + 0.2 * lobe * lobe + 0.05 * second, diffuse + 0.25 * second};
}

inline Vec3 isotropic_colour(const Vec3& n) {
  return Vec3(0.4, 0.3, 0.2) + 0.3 * n;
}

/// One photograph of a sphere covered with it, background `background` outside the disc.
template <class Colour>
Image photograph(int size, Colour colour, float background = 0) {
  Image image(size, size, 3, background);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, size);
      if (disc.norm() < 1) image.set_rgb(x, y, colour(normal_on_disc(disc)).template cast<float>());
    }
  }
  return image;
}

/// A full turn of `count` photographs with equal steps.
inline std::vector<amc::AmcFrame> analytic_frames(int size, int count, int symmetry) {
  std::vector<amc::AmcFrame> frames;
  for (int i = 0; i < count; ++i) {
    const double k = static_cast<double>(i) / count;
    frames.push_back({photograph(size, [&](const Vec3& n) { return analytic_colour(n, k, symmetry); }), k});
  }
  return frames;
}

/// The table that samples the material exactly at texel centres (beyond the disc: at the rim).
inline amc::AmcTable analytic_table(int size, int slices, int symmetry) {
  amc::AmcTable table(size, slices, symmetry);
  for (int f = 0; f < slices; ++f) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3 n = normal_on_disc({2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1});
        table.set_texel(x, y, f, analytic_colour(n, table.slice_angle(f), symmetry).cast<float>());
      }
    }
  }
  return table;
}

}  // namespace sateen::test
