// SPDX-License-Identifier: MIT
#include "sateen/core/display.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/core/exposure.h"

namespace sateen {
namespace {

Image two_by_two(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  Image image(2, 2, 3);
  image.set_rgb(0, 0, a);
  image.set_rgb(1, 0, b);
  image.set_rgb(0, 1, c);
  image.set_rgb(1, 1, d);
  return image;
}

TEST(Display, AStopIsAFactorOfTwo) {
  EXPECT_EQ(display_gain({.exposure = 3}), 8);
  EXPECT_EQ(display_gain({.exposure = -1}), 0.5);
  const Image shown = displayed(Image(1, 1, 3, 0.1f), {.exposure = 2});
  EXPECT_NEAR(shown.at(0, 0, 0), 0.4, 1e-6);
}

TEST(Display, ColourIsSeenThroughTheViewWithoutItsAlpha) {
  Image light(1, 1, 4);
  light.data = {0.5f, 0.25f, 1.0f, 0.25f};  // the light of (2, 1, 4) on a quarter of the pixel
  const Vec3 expected = shown_light(ViewTransform::agx, {2, 1, 4}) * 0.25;
  const Image shown = displayed(light, {.view = ViewTransform::agx});
  EXPECT_LT((shown.rgb(0, 0).cast<double>() - expected).norm(), 1e-6);
  EXPECT_EQ(shown.at(0, 0, 3), 0.25f);
}

TEST(Display, EmptyPixelsStayEmpty) {
  const Image shown = displayed(Image(1, 1, 4), {.exposure = 5, .view = ViewTransform::agx});
  EXPECT_EQ(shown.data, std::vector<float>(4, 0.0f));
}

TEST(Display, GreyPicturesAndTheirAlphaAreKnown) {
  Image light(1, 1, 2);
  light.data = {0.1f, 0.5f};
  const Image shown = displayed(light, {.exposure = 1});
  EXPECT_NEAR(shown.at(0, 0, 0), 0.2, 1e-6);
  EXPECT_EQ(shown.at(0, 0, 1), 0.5f);
}

// The file's encoding of the result gives the linear value.
TEST(Display, NoneTakesTheEncodingOffBeforehand) {
  for (const float v : {0.0f, 0.001f, 0.18f, 0.5f, 1.0f}) {
    const Image shown = displayed(Image(1, 1, 3, v), {.view = ViewTransform::none});
    EXPECT_NEAR(srgb_encode(shown.at(0, 0, 0)), v, 1e-6);
  }
  EXPECT_NEAR(displayed(Image(1, 1, 3, 7.0f), {.view = ViewTransform::none}).at(0, 0, 0), 1, 1e-6);
}

TEST(Display, ABackgroundShowsWhereNothingIs) {
  Image light(2, 1, 4);
  light.data = {0, 0, 0, 0, 0.1f, 0.1f, 0.1f, 0.5f};
  const Image whole = over_background(light, {1, 0.5f, 0});
  EXPECT_EQ(whole.data, (std::vector<float>{1, 0.5f, 0, 1, 0.6f, 0.35f, 0.1f, 1}));
  EXPECT_EQ(over_background(Image(1, 1, 3, 0.2f), {1, 1, 1}).data, Image(1, 1, 3, 0.2f).data);
}

TEST(Exposure, EvenLightBecomesMiddleGrey) {
  for (const float light : {0.001f, 0.18f, 40.0f}) {
    EXPECT_NEAR(std::exp2(automatic_exposure(Image(8, 8, 3, light))) * light, 0.18, 1e-6);
  }
}

// The geometric mean of 0.01, 0.01, 0.09, 0.09 is 0.03.
TEST(Exposure, TheMeanIsThatOfLogarithms) {
  const Vec3f dark = Vec3f::Constant(0.01f);
  const Vec3f bright = Vec3f::Constant(0.09f);
  EXPECT_NEAR(automatic_exposure(two_by_two(dark, dark, bright, bright)), std::log2(0.18 / 0.03), 1e-5);
}

TEST(Exposure, ADeepColourIsNotLiftedToAPaleOne) {
  Image light(4, 4, 3);
  for (int i = 0; i < 16; ++i) light.set_rgb(i % 4, i / 4, {0, 0, 0.18f});
  EXPECT_NEAR(automatic_exposure(light), 0, 1e-6);
}

// The dark pixels ask for more, but then the others would be whiter than white.
TEST(Exposure, BrightPartsKeepTheirDetail) {
  Image light(10, 10, 3, 0.02f);
  for (int x = 0; x < 10; ++x) light.set_rgb(x, 0, {4, 0.5f, 0.25f});
  EXPECT_NEAR(automatic_exposure(light), -2, 1e-6);
}

TEST(Exposure, AFewSparksDoNotDecide) {
  Image light(10, 10, 3, 0.1f);
  light.set_rgb(3, 3, {1000, 1000, 1000});
  EXPECT_NEAR(automatic_exposure(light), std::log2(1.8), 0.2);
}

TEST(Exposure, BlackCornersDoNotDecide) {
  Image light(10, 10, 3, 0.1f);
  for (int x = 0; x < 10; ++x) light.set_rgb(x, 0, {0, 0, 0});
  EXPECT_NEAR(automatic_exposure(light), std::log2(1.8) + 0.8, 1e-5);  // a tenth of the pixels, eight stops
}

TEST(Exposure, OnlyCoveredPixelsCount) {
  Image light(4, 4, 4);
  light.at(1, 1, 0) = light.at(1, 1, 1) = light.at(1, 1, 2) = 0.05f;
  light.at(1, 1, 3) = 0.5f;  // the light of 0.1 on half of the pixel
  EXPECT_NEAR(automatic_exposure(light), std::log2(1.8), 1e-6);
}

TEST(Exposure, TwiceTheLightIsOneStopLess) {
  Image light = two_by_two({0.1f, 0.2f, 0.3f}, {3, 0.1f, 0}, {0, 0, 0}, {0.5f, 0.6f, 0.01f});
  const double before = automatic_exposure(light);
  for (float& v : light.data) v *= 2;
  EXPECT_NEAR(automatic_exposure(light), before - 1, 1e-6);
}

TEST(Exposure, NothingToMeterIsZero) {
  EXPECT_EQ(automatic_exposure(Image(4, 4, 4)), 0);
  EXPECT_EQ(automatic_exposure(Image(4, 4, 3)), 0);
  Image light(2, 1, 3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(automatic_exposure(light), 0);
  light.set_rgb(0, 0, {0.18f, 0.18f, 0.18f});
  EXPECT_NEAR(automatic_exposure(light), 0, 1e-6);
}

}  // namespace
}  // namespace sateen
