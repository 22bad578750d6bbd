// SPDX-License-Identifier: MIT
#include "sateen/matcap/support_function.h"

#include <cfloat>
#include <functional>

#include <gtest/gtest.h>

#include "support/opening_brute_force.h"

namespace sateen::matcap {
namespace {

using Scale = std::function<float(double x, double y, double z)>;

LaneValues scale_of(const SphereTiles& tiles, const Scale& scale) {
  LaneValues values(tiles.pixel.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (tiles.pixel[i] >= 0) values[i] = scale(tiles.x[i], tiles.y[i], tiles.z[i]);
  }
  return values;
}

/// How many of some thousand directions of a large picture get another result than from trying every point.
int differing_directions(int size, const SphereTiles& tiles, const LaneValues& scale) {
  constexpr std::size_t kStride = 131;  // prime, so that packets come from everywhere
  const LaneValues fast = support_of_scaled_normals(tiles, scale);
  std::vector<float> by_pixel(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  std::vector<float> scale_by_pixel(by_pixel.size());
  for (std::size_t i = 0; i < fast.size(); ++i) {
    if (tiles.pixel[i] < 0) continue;
    by_pixel[static_cast<std::size_t>(tiles.pixel[i])] = fast[i];
    scale_by_pixel[static_cast<std::size_t>(tiles.pixel[i])] = scale[i];
  }
  const test::SpherePixels pixels = test::sphere_pixels(size, size, inscribed_disc(size, size));
  std::vector<float> x, y, z;
  for (std::size_t i = 0; i < pixels.pixel.size(); ++i) {
    const float s = scale_by_pixel[pixels.pixel[i]];
    if (!(s > 0)) continue;
    x.push_back(s * pixels.x[i]);
    y.push_back(s * pixels.y[i]);
    z.push_back(s * pixels.z[i]);
  }
  const std::vector<float> slow = test::support_brute_force(pixels, x, y, z, kStride);
  int compared = 0;
  int differing = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    if (slow[i] == -FLT_MAX) continue;
    ++compared;
    differing += slow[i] == by_pixel[pixels.pixel[i]] ? 0 : 1;
  }
  EXPECT_GT(compared, 1000);
  return differing;
}

// Large pictures are where boxes become so small that the rounding of their bounds counts, most of all when
// all points are equally far away (a constant) or in one plane (a cosine lobe).
TEST(SupportFunction, EqualsTryingEveryPointOnLargePictures) {
  constexpr int kSize = 480;
  const SphereTiles tiles = tile_sphere(kSize, kSize, inscribed_disc(kSize, kSize));
  const Scale constant = [](double, double, double) { return 3.3F; };
  const Scale lobe = [](double x, double y, double z) {
    return static_cast<float>(1 / std::max(0.3 * x + 0.4 * y + 0.8 * z, 1e-20));
  };
  const Scale steps = [](double x, double y, double) {
    return 255 / static_cast<float>(std::round(255 * (0.5 + 0.2 * x + 0.1 * y)));
  };
  const Scale two = [](double x, double, double) { return x < 0.1 ? 0.3F : 0.6F; };
  for (const Scale& scale : {constant, lobe, steps, two}) {
    const LaneValues values = scale_of(tiles, scale);
    EXPECT_EQ(differing_directions(kSize, tiles, values), 0);
    // The points of a dilation lie on a convex surface.
    LaneValues eroded = support_of_scaled_normals(tiles, values);
    for (float& v : eroded) v = 1 / v;
    EXPECT_EQ(differing_directions(kSize, tiles, eroded), 0);
  }
}

TEST(SupportFunction, WorksOnTheSmallestPictures) {
  for (int size = 4; size < 20; ++size) {
    const Disc disc = inscribed_disc(size, size);
    const SphereTiles tiles = tile_sphere(size, size, disc);
    const LaneValues none(tiles.pixel.size(), 0);
    for (const float v : support_of_scaled_normals(tiles, none)) EXPECT_EQ(v, -FLT_MAX);
    const LaneValues scale = scale_of(tiles, [](double x, double y, double) {
      return static_cast<float>(1.5 + std::sin(9 * x) * std::cos(7 * y));
    });
    const LaneValues fast = support_of_scaled_normals(tiles, scale);
    for (std::size_t p = 0; p < fast.size(); ++p) {
      float best = -FLT_MAX;
      for (std::size_t q = 0; q < fast.size(); ++q) {
        if (tiles.pixel[q] < 0) continue;
        const float ax = scale[q] * tiles.x[q];
        const float ay = scale[q] * tiles.y[q];
        const float az = scale[q] * tiles.z[q];
        best = std::max(best, (tiles.x[p] * ax + tiles.y[p] * ay) + tiles.z[p] * az);
      }
      EXPECT_EQ(fast[p], best) << size;
    }
  }
}

}  // namespace
}  // namespace sateen::matcap
