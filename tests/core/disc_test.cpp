// SPDX-License-Identifier: MIT
#include "sateen/core/disc.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sateen/core/direction.h"

namespace sateen {
namespace {

/// A sphere whose colour is a smooth function of the normal, before a glaring background.
Image sphere(int size, float background) {
  Image image(size, size, 1, background);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, size);
      const double half_pixel = 1.0 / size;
      if (disc.norm() < 1 - half_pixel)
        image.at(x, y, 0) = static_cast<float>(0.5 + 0.3 * disc.x() + 0.2 * disc.y());
    }
  }
  return image;
}

TEST(Disc, PixelsInsideItAreInsideWithAllTheirCorners) {
  for (const int size : {7, 16}) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        double farthest = 0;
        for (const int i : {0, 1}) {
          for (const int j : {0, 1})
            farthest = std::max(farthest, std::hypot(x + i - size / 2.0, y + j - size / 2.0));
        }
        EXPECT_EQ(inside_disc(x, y, size), farthest <= size / 2.0 - kRimInset) << x << " " << y;
      }
    }
  }
}

TEST(Disc, FillingLeavesNoTraceOfTheBackgroundAndTheDiscAsItWas) {
  for (const int size : {16, 64, 127}) {
    const Image original = sphere(size, 100);
    Image filled = original;
    fill_from_rim(filled);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        EXPECT_LT(filled.at(x, y, 0), 1.1f) << x << " " << y;
        if (inside_disc(x, y, size)) {
          EXPECT_EQ(filled.at(x, y, 0), original.at(x, y, 0));
        }
      }
    }
  }
}

TEST(Disc, TheCornerTakesTheRimsColour) {
  Image image = sphere(128, 0);
  fill_from_rim(image);
  const double rim = 0.5 + 0.3 * std::sqrt(0.5) + 0.2 * std::sqrt(0.5);
  EXPECT_NEAR(image.at(127, 0, 0), rim, 0.02);
}

TEST(Disc, ShrinkingAveragesTrustedPixelsOnly) {
  const Image small = resized_disc(sphere(256, 1000), 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const Vec2 disc = disc_of_pixel(x, y, 32);
      if (disc.norm() < 1) {
        EXPECT_NEAR(small.at(x, y, 0), 0.5 + 0.3 * disc.x() + 0.2 * disc.y(), 0.02);
      }
    }
  }
}

}  // namespace
}  // namespace sateen
