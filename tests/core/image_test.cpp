// SPDX-License-Identifier: MIT
#include "sateen/core/image.h"

#include <array>
#include <cstring>
#include <numeric>

#include <gtest/gtest.h>

#include "sateen/core/picture_texture.h"

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

TEST(Image, EnlargedPixelsStandAroundTheirOwn) {
  // Twice as many pixels stand a quarter of a pixel to either side of each; the edge goes on as it is.
  EXPECT_EQ(resized(ramp(3, 1, 1), 6, 1).data, (std::vector<float>{0, 0.25f, 0.75f, 1.25f, 1.75f, 2}));
}

TEST(Image, RegionsAreCutOutOfPicturesTheyFit) {
  EXPECT_TRUE(fits({1, 2, 3, 2}, 4, 4));
  EXPECT_FALSE(fits({1, 2, 4, 2}, 4, 4));
  EXPECT_FALSE(fits({1, 2, 3, 3}, 4, 4));
  EXPECT_FALSE(fits({-1, 0, 2, 2}, 4, 4));
  EXPECT_FALSE(fits({0, 0, 0, 1}, 4, 4));
  EXPECT_EQ(cropped(ramp(4, 4, 1), {1, 2, 3, 2}).data, (std::vector<float>{9, 10, 11, 13, 14, 15}));
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

TEST(Image, TexturesBeginAtTheLowerLeftCornerAndHoldNothingInfinite) {
  Image picture(2, 2, 1);
  picture.data = {0.25f, -1e6f, 0.5f, 1e6f};
  const TextureData texture = picture_texture(picture);
  std::array<Half, 16> texels;
  ASSERT_EQ(texture.levels[0].size(), sizeof texels);
  std::memcpy(texels.data(), texture.levels[0].data(), sizeof texels);
  const auto grey = [&](std::size_t i) { return static_cast<float>(texels[4 * i + 1]); };
  EXPECT_EQ(grey(0), 0.5f);
  EXPECT_EQ(grey(1), 65504);
  EXPECT_EQ(grey(2), 0.25f);
  EXPECT_EQ(grey(3), -65504);
  EXPECT_EQ(static_cast<float>(texels[3]), 1);
  const std::array<float, 2> bright = {1e6f, -1e6f};
  std::array<Half, 2> halves;
  const std::vector<std::byte> bytes = half_bytes(bright);
  ASSERT_EQ(bytes.size(), sizeof halves);
  std::memcpy(halves.data(), bytes.data(), sizeof halves);
  EXPECT_EQ(static_cast<float>(halves[0]), 65504);
  EXPECT_EQ(static_cast<float>(halves[1]), -65504);
}

TEST(Image, RepeatedPicturesGoOnOverEveryEdge) {
  const Image picture = ramp(4, 3, 1);
  const auto sample = [&](double u, double v) {
    double value = 0;
    sample_repeating(picture, {u, v}, {&value, 1});
    return value;
  };
  EXPECT_NEAR(sample(0.125, 1 / 6.0), 8, 1e-12);  // the first pixel of the last row
  EXPECT_NEAR(sample(-0.875, 13 / 6.0), 8, 1e-12);
  EXPECT_NEAR(sample(0.375, 0), (1 + 9) / 2.0, 1e-12);  // between the last row and the first
  EXPECT_NEAR(sample(1, 0.5), (4 + 7) / 2.0, 1e-12);    // between the last column and the first
}

}  // namespace
}  // namespace sateen
