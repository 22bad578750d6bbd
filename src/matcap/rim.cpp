// SPDX-License-Identifier: MIT
#include "sateen/matcap/rim.h"

#include <algorithm>
#include <cmath>

namespace sateen::matcap {
namespace {

constexpr double kRimWidth = 1.5;  // pixels: those that mix with the background, also in a resized picture
constexpr double kInside = 1.5;    // pixels further in, where colours are compared
constexpr double kSmooth = 0.03;   // of the mean value: a rim no darker than that is not mixed
constexpr double kSmallestRadius = 16;  // pixels: smaller spheres have none to lose

}  // namespace

bool on_rim(const Disc& disc, double width, int x, int y) {
  return on_disc(disc, x, y) && !on_disc({disc.x, disc.y, disc.radius - width}, x, y);
}

double rim_width(const Image& picture, const Disc& disc) {
  if (disc.radius < kSmallestRadius) return 0;
  double difference = 0;
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!on_rim(disc, kRimWidth, x, y)) continue;
      const Vec2 p = disc_point(disc, x + 0.5, y + 0.5);
      // Linear in the normal's z: smooth shading falls steeply towards the rim.
      const auto z_of = [](double r) { return std::sqrt(std::max(0.0, 1 - r * r)); };
      const auto colour_at = [&](double r) {
        const Vec2 q = disc_pixel(disc, p * r / p.norm());
        Vec3 colour;
        sample_bilinear(picture, q.x(), q.y(), {colour.data(), 3});
        return colour;
      };
      const double near = 1 - (kRimWidth + kInside) / disc.radius;
      const double far = near - kInside / disc.radius;
      const Vec3 inside = colour_at(near);
      const double steps = (z_of(near) - z_of(p.norm())) / (z_of(far) - z_of(near));
      const Vec3 expected = inside + steps * (inside - colour_at(far));
      difference += (expected - picture.rgb(x, y).cast<double>()).sum();
      sum += inside.cwiseAbs().sum();
    }
  }
  return difference > kSmooth * sum ? kRimWidth : 0;
}

}  // namespace sateen::matcap
