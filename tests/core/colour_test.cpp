// SPDX-License-Identifier: MIT
#include "sateen/core/colour.h"

#include <gtest/gtest.h>

namespace sateen {
namespace {

TEST(Colour, SrgbMatchesTheStandardsPublishedValues) {
  EXPECT_NEAR(srgb_decode(0.5f), 0.2140411f, 1e-6f);
  EXPECT_NEAR(srgb_encode(0.18f), 0.4613561f, 1e-6f);
  EXPECT_NEAR(srgb_encode(0.001f), 0.01292f, 1e-7f);
  EXPECT_FLOAT_EQ(srgb_decode(1), 1);
}

TEST(Colour, SrgbRoundTripsIncludingNegativeAndBrightValues) {
  for (float v = -2; v < 8; v += 0.037f)
    EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 1e-5f + 1e-5f * std::abs(v));
}

TEST(Colour, AlphaHasNoCurve) {
  const Image half(1, 1, 4, 0.5f);
  EXPECT_EQ(srgb_encoded(half).at(0, 0, 2), srgb_encode(0.5f));
  EXPECT_EQ(srgb_encoded(half).at(0, 0, 3), 0.5f);
  EXPECT_EQ(srgb_decoded(half).at(0, 0, 2), srgb_decode(0.5f));
  EXPECT_EQ(srgb_decoded(half).at(0, 0, 3), 0.5f);
}

TEST(Colour, LuminanceIsThatOfRec709) {
  EXPECT_NEAR(luminance({1, 0, 0}), 0.2126, 1e-4);
  EXPECT_NEAR(luminance({0, 1, 0}), 0.7152, 1e-4);
  EXPECT_NEAR(luminance({0, 0, 1}), 0.0722, 1e-4);
}

TEST(Colour, HsvOfKnownColours) {
  EXPECT_TRUE(rgb_to_hsv({1, 0, 0.5}).isApprox(Vec3(11.0 / 12, 1, 1)));
  EXPECT_TRUE(rgb_to_hsv({1, 0, 0}).isApprox(Vec3(0, 1, 1)));
  EXPECT_TRUE(rgb_to_hsv({0, 0.5, 0}).isApprox(Vec3(1.0 / 3, 1, 0.5)));
  EXPECT_TRUE(rgb_to_hsv({0.25, 0.25, 1}).isApprox(Vec3(2.0 / 3, 0.75, 1)));
  EXPECT_TRUE(rgb_to_hsv({0.3, 0.3, 0.3}).isApprox(Vec3(0, 0, 0.3)));
}

TEST(Colour, HsvRoundTrips) {
  for (double r = 0; r <= 2; r += 0.25) {
    for (double g = 0; g <= 2; g += 0.25) {
      for (double b = 0; b <= 2; b += 0.25) {
        EXPECT_LT((hsv_to_rgb(rgb_to_hsv({r, g, b})) - Vec3(r, g, b)).norm(), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace sateen
