// SPDX-License-Identifier: MIT
#include "sateen/core/image.h"

#include <numeric>

#include <gtest/gtest.h>

namespace sateen {
namespace {

Image ramp(int width, int height, int channels) {
  Image image(width, height, channels);
  std::iota(image.data.begin(), image.data.end(), 0.0f);
  return image;
}

TEST(Image, ShrinkingByAWholeFactorIsTheBlockMean) {
  const Image small = resized(ramp(6, 4, 1), 3, 2);
  EXPECT_FLOAT_EQ(small.at(0, 0, 0), (0 + 1 + 6 + 7) / 4.0f);
  EXPECT_FLOAT_EQ(small.at(2, 1, 0), (16 + 17 + 22 + 23) / 4.0f);
}

TEST(Image, ShrinkingByAnyFactorKeepsTheMean) {
  const Image image = ramp(97, 61, 3);
  const Image small = resized(image, 13, 8);
  for (int c = 0; c < 3; ++c) {
    const auto mean = [&](const Image& i) {
      double sum = 0;
      for (int y = 0; y < i.height; ++y) {
        for (int x = 0; x < i.width; ++x) sum += i.at(x, y, c);
      }
      return sum / (i.width * i.height);
    };
    EXPECT_NEAR(mean(small), mean(image), 0.05);
  }
}

TEST(Image, EnlargingAConstantOrASinglePixelKeepsIt) {
  for (const float v : resized(Image(1, 1, 2, 0.3f), 5, 7).data) EXPECT_FLOAT_EQ(v, 0.3f);
}

TEST(Image, ChannelsAreRepeatedForGreyAndOpaqueForMissingAlpha) {
  const Image rgba = with_channels(Image(2, 2, 1, 0.25f), 4);
  EXPECT_EQ(rgba.rgb(1, 1), Vec3f(0.25f, 0.25f, 0.25f));
  EXPECT_EQ(rgba.at(1, 1, 3), 1);
  const Image grey_alpha = with_channels(Image(1, 1, 2, 0.5f), 4);
  EXPECT_EQ(grey_alpha.at(0, 0, 2), 0.5f);
  EXPECT_EQ(grey_alpha.at(0, 0, 3), 0.5f);
}

TEST(Image, BilinearSamplesAreExactAtCentresAndLinearBetween) {
  const Image image = ramp(4, 3, 1);
  double value = 0;
  sample_bilinear(image, 2.5, 1.5, {&value, 1});
  EXPECT_DOUBLE_EQ(value, 6);
  sample_bilinear(image, 2.0, 2.0, {&value, 1});
  EXPECT_DOUBLE_EQ(value, 7.5);
  sample_bilinear(image, -3, 9, {&value, 1});
  EXPECT_DOUBLE_EQ(value, 8);
}

}  // namespace
}  // namespace sateen
