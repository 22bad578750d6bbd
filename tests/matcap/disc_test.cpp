// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/matcap/sphere_disc.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

/// A shaded ball before a background of one value.
Image ball(int width, int height, const Disc& disc, float background, int channels = 3) {
  Image image(width, height, channels, background);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool inside = on_disc(disc, x, y);
      const Vec3 n = normal_on_disc(disc_point(disc, x + 0.5, y + 0.5));
      if (inside)
        image.set_rgb(
            x, y, Vec3f::Constant(static_cast<float>(0.2 + 0.6 * std::max(0.0, n.dot(Vec3(0.6, 0.6, 0.5))))));
      if (channels == 4) image.at(x, y, 3) = inside ? 1.0F : 0.0F;
    }
  }
  return image;
}

void expect_found(const Image& image, const Disc& truth) {
  const Disc found = find_disc(image, "test");
  EXPECT_NEAR(found.x, truth.x, 1);
  EXPECT_NEAR(found.y, truth.y, 1);
  EXPECT_NEAR(found.radius, truth.radius, 1);
}

TEST(FindDisc, FindsASphereSmallerThanThePicture) {
  for (const float background : {0.0F, 1.0F, 0.1F}) {
    expect_found(ball(200, 200, {90, 110, 70}, background), {90, 110, 70});
    expect_found(ball(320, 200, {180.5, 100, 85}, background), {180.5, 100, 85});
  }
}

TEST(FindDisc, TrustsAlpha) {
  expect_found(ball(160, 160, {80, 75, 60}, 0.4F, 4), {80, 75, 60});
}

TEST(FindDisc, ADarkPartOfTheRimOnBlackDoesNotPullItIn) {
  Image image = ball(200, 200, {100, 100, 80}, 0);
  for (int y = 150; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) image.set_rgb(x, y, Vec3f::Zero());
  }
  expect_found(image, {100, 100, 80});
}

TEST(FindDisc, MatCapsThatFillTheirPictureGetTheInscribedDisc) {
  for (const char* name : test::kMatcaps) {
    const Disc disc = find_disc(test::example_matcap(name, 128), name);
    EXPECT_EQ(disc.x, 64) << name;
    EXPECT_EQ(disc.radius, 64) << name;
  }
  EXPECT_EQ(find_disc(Image(64, 64, 3), "black").radius, 32);
}

TEST(FindDisc, SaysWhatIsWrong) {
  EXPECT_THROW(find_disc(Image(1, 1, 3), "pixel"), Error);
  EXPECT_THROW(find_disc(Image(200, 100, 3, 0.5F), "flat"), Error);
  EXPECT_THROW(check_disc({50, 50, 60}, 100, 100, "test"), Error);
  EXPECT_THROW(check_disc({50, 50, std::nan("")}, 100, 100, "test"), Error);
  EXPECT_NO_THROW(check_disc({50, 50, 50}, 100, 100, "test"));
}

}  // namespace
}  // namespace sateen::matcap
