// SPDX-License-Identifier: MIT
#include "sateen/matcap/separation.h"

#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "support/matcaps.h"
#include "support/opening_brute_force.h"

namespace sateen::matcap {
namespace {

std::vector<float> channel(const Image& image, int c) {
  std::vector<float> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) values.push_back(image.at(x, y, c));
  }
  return values;
}

int differing_pixels(const std::vector<float>& values, const std::vector<char>& ignored, int width,
                     int height, const Disc& disc) {
  const auto fast = cosine_opening(values, ignored, width, height, disc);
  const auto slow = test::opening_brute_force(values, ignored, width, height, disc);
  int differing = 0;
  for (std::size_t i = 0; i < fast.size(); ++i) differing += fast[i] == slow[i] ? 0 : 1;
  return differing;
}

TEST(CosineOpening, EqualsComparingAllPairsBitForBitOnRealMatCaps) {
  for (const char* name : test::kMatcaps) {
    for (const int size : {64, 97, 128}) {
      const Image image = to_add_up_space(test::example_matcap(name, size), AddUpSpace::display);
      const Disc disc = inscribed_disc(size, size);
      const std::vector<float> values = channel(image, size % 3);
      EXPECT_EQ(differing_pixels(values, find_outliers(values, size, size, disc), size, size, disc), 0)
          << name << size;
    }
  }
  const Image large = to_add_up_space(test::example_matcap("ceramic", 192), AddUpSpace::display);
  EXPECT_EQ(differing_pixels(channel(large, 1), {}, 192, 192, inscribed_disc(192, 192)), 0);
}

TEST(CosineOpening, EqualsComparingAllPairsInOddCases) {
  constexpr int kSize = 64;
  const Disc disc = inscribed_disc(kSize, kSize);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> flat(kSize * kSize, 0.3F);
  std::vector<float> noise(flat.size());
  std::vector<float> hdr(flat.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    noise[i] = uniform(random) - 0.1F;
    hdr[i] = std::exp(20 * uniform(random) - 10);
  }
  std::vector<float> hole = flat;
  hole[kSize * 30 + 30] = 0;
  std::vector<float> one(flat.size(), 0);
  one[kSize * 20 + 40] = 5;
  const std::vector<float> black(flat.size(), 0);
  for (const std::vector<float>& values : {flat, noise, hdr, hole, one, black}) {
    EXPECT_EQ(differing_pixels(values, {}, kSize, kSize, disc), 0);
  }
  EXPECT_EQ(differing_pixels(noise, find_outliers(noise, kSize, kSize, disc), kSize, kSize, disc), 0);
  // A sphere that is smaller than its picture, off its middle, and not on pixel borders.
  EXPECT_EQ(differing_pixels(noise, {}, kSize, kSize, {29.3, 33.8, 22.6}), 0);
}

/// Pictures on which all points are equally far away, or in one plane, or on steps, or far apart.
std::vector<float> smooth_picture(int size,
                                  const std::function<double(double x, double y, double z)>& value) {
  std::vector<float> values;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 p = disc_of_pixel(x, y, size);
      const double z = std::sqrt(std::max(0.0, 1 - p.squaredNorm()));
      values.push_back(static_cast<float>(value(p.x(), p.y(), z)));
    }
  }
  return values;
}

std::vector<std::vector<float>> flat_and_smooth_pictures(int size) {
  std::vector<std::vector<float>> pictures;
  const auto add = [&](const std::function<double(double x, double y, double z)>& value) {
    pictures.push_back(smooth_picture(size, value));
  };
  add([](double, double, double) { return 0.3; });                               // constant
  add([](double x, double, double) { return x < 0.1 ? 0.3 : 0.6; });             // two values
  add([](double x, double y, double) { return (x < 0) == (y < 0) ? 0 : 0.5; });  // half of it black
  add([](double x, double, double) { return 0.2 + 0.3 * (x + 1); });             // gradients
  add([](double x, double y, double) { return 0.9 - 0.6 * (x * x + y * y); });
  add([](double x, double y, double z) { return 0.4 * x + 0.3 * y + 0.866 * z; });  // a cosine lobe
  add([](double x, double y, double) { return std::round(255 * (0.5 + 0.2 * x + 0.1 * y)) / 255; });
  add([](double x, double y, double) {  // 0, and 0.1 to 1000
    const double r2 = (x - 0.3) * (x - 0.3) + y * y;
    return r2 < 0.3 ? 1000 * std::exp(-30 * r2) : 0;
  });
  return pictures;
}

TEST(CosineOpening, EqualsComparingAllPairsOnFlatAndSmoothPictures) {
  for (const int size : {64, 90}) {
    const Disc disc = inscribed_disc(size, size);
    for (const std::vector<float>& values : flat_and_smooth_pictures(size)) {
      EXPECT_EQ(differing_pixels(values, {}, size, size, disc), 0);
    }
  }
}

TEST(CosineOpening, NeverExceedsFlatAndSmoothPicturesAndIsIdempotent) {
  const int size = 90;
  const Disc disc = inscribed_disc(size, size);
  for (const std::vector<float>& values : flat_and_smooth_pictures(size)) {
    // A dark pixel v erodes another to e from where the cosine is v / e; that cosine is exact to 3e-7.
    float darkest = 1;
    for (const float v : values) darkest = v > 0 ? std::min(darkest, v) : darkest;
    const auto once = cosine_opening(values, {}, size, size, disc);
    const auto twice = cosine_opening(once, {}, size, size, disc);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_LE(once[i], std::max(0.0F, values[i]));
      EXPECT_NEAR(twice[i], once[i], 2e-6F * std::max(1.0F, once[i]) + 3e-7F * once[i] * once[i] / darkest);
    }
  }
}

TEST(CosineOpening, NeverExceedsTheInputAndIsIdempotent) {
  for (const char* name : {"jade", "carpaint"}) {
    const int size = 128;
    const Image image = to_add_up_space(test::example_matcap(name, size), AddUpSpace::display);
    const Disc disc = inscribed_disc(size, size);
    for (int c = 0; c < 3; ++c) {
      const auto values = channel(image, c);
      const auto once = cosine_opening(values, {}, size, size, disc);
      const auto twice = cosine_opening(once, {}, size, size, disc);
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_LE(once[i], std::max(0.0F, values[i]));
        EXPECT_NEAR(twice[i], once[i], 2e-6F * std::max(1.0F, once[i]));
      }
    }
  }
}

// A cosine lobe is what the structuring function leaves alone; a narrow highlight on top of it goes to high.
TEST(Separation, KeepsACosineLobeAndRemovesAHighlight) {
  const int size = 128;
  const Vec3 light = test::direction_at(0.4, 1);
  const Vec3 lamp = test::direction_at(0.5, 4);
  const Image image = test::sphere_picture(size, [&](const Vec3& n) -> Vec3 {
    const double angle = test::angle_between(n, lamp);
    return Vec3(0.8, 0.5, 0.2) * std::max(0.0, n.dot(light)) +
           Vec3::Constant(0.6 * std::exp(-angle * angle / 0.01));
  });
  const Disc disc = inscribed_disc(size, size);
  const Separation parts = separate(image, disc, Outliers::ignore, "test");
  double worst = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 p = disc_of_pixel(x, y, size);
      if (p.norm() > 0.95) continue;
      const Vec3 n = normal_on_disc(p);
      const double expected = 0.8 * std::max(0.0, n.dot(light));
      worst = std::max(worst, std::abs(parts.low.at(x, y, 0) - expected));
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(parts.low.at(x, y, c) + parts.high.at(x, y, c), image.at(x, y, c));
        EXPECT_GE(parts.high.at(x, y, c), 0);
      }
    }
  }
  EXPECT_LT(worst, 0.02);
}

TEST(Separation, OneBlackPixelBlackensLowOnlyIfAsked) {
  const int size = 64;
  Image image(size, size, 3, 0.5F);
  image.set_rgb(30, 22, Vec3f::Zero());
  const Disc disc = inscribed_disc(size, size);
  const Separation kept = separate(image, disc, Outliers::keep, "test");
  const Separation ignored = separate(image, disc, Outliers::ignore, "test");
  EXPECT_LT(kept.low.at(32, 32, 0), 0.3F);
  EXPECT_GT(ignored.low.at(32, 32, 0), 0.45F);
  EXPECT_EQ(ignored.low.at(30, 22, 0), 0);
}

TEST(Separation, NegativeValuesStayInHighAndNaNIsRefused) {
  const int size = 32;
  Image image(size, size, 3, 0.5F);
  image.set_rgb(10, 10, Vec3f::Constant(-0.01F));
  const Separation parts = separate(image, inscribed_disc(size, size), Outliers::ignore, "test");
  EXPECT_EQ(parts.low.at(10, 10, 0), 0);
  EXPECT_EQ(parts.high.at(10, 10, 0), -0.01F);
  image.at(5, 6, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(separate(image, inscribed_disc(size, size), Outliers::ignore, "test"), Error);
}

}  // namespace
}  // namespace sateen::matcap
