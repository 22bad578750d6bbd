// SPDX-License-Identifier: MIT
#include "sateen/amc/lookup.h"

#include <random>

#include <gtest/gtest.h>

#include "sateen/amc/appearance.h"
#include "sateen/amc/sheet.h"
#include "support/analytic_material.h"

namespace sateen::amc {
namespace {

using test::analytic_colour;
using test::analytic_table;

TEST(AmcLookup, IsExactAtTexelCentresForEveryPeriod) {
  for (const int symmetry : {1, 2, 3, 4}) {
    const AmcTable table = analytic_table(17, 9, symmetry);
    for (int f = 0; f < table.slices; ++f) {
      for (int y = 0; y < 17; ++y) {
        for (int x = 0; x < 17; ++x) {
          const Vec3 n(2 * (x + 0.5) / 17 - 1, 2 * (y + 0.5) / 17 - 1, 0.1);
          const Vec3 expected = table.texel(x, y, f).cast<double>();
          for (int period = -1; period <= symmetry; ++period) {
            const double k = table.slice_angle(f) + static_cast<double>(period) / symmetry;
            EXPECT_LT((lookup(table, n, k) - expected).norm(), 1e-5);
          }
        }
      }
    }
  }
}

TEST(AmcLookup, StaysWithinTrilinearErrorOfTheFunctionItWasFilledFrom) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int size : {32, 64}) {
    const AmcTable table = analytic_table(size, size, 2);
    // Second derivatives: at most about 5 in n and (2 pi R)^2 * 1.2 along k; an error of h^2 / 8 times each,
    // plus halves.
    const double h = 2.0 / size;
    const double hk = 0.5 / size;
    const double bound = h * h / 8 * 2 * 5 + hk * hk / 8 * 16 * kPi * kPi * 1.2 + 1e-3;
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec2 disc(uniform(random), uniform(random));
      if (disc.norm() > 1 - 2 * h) continue;
      const Vec3 n = normal_on_disc(disc);
      const double k = uniform(random);
      worst = std::max(worst, (lookup(table, n, k) - analytic_colour(n, k, 2)).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(worst, bound) << size;
  }
}

TEST(AmcLookup, TakesTheTangentsDirectionInThePicturePlane) {
  const AmcTable table = analytic_table(16, 32, 1);
  const Vec3 n = Vec3(0.2, -0.4, 0.8).normalized();
  EXPECT_LT((lookup(table, n, Vec3(0, 3, -1)) - lookup(table, n, 0.25)).norm(), 1e-12);
  EXPECT_LT((lookup(table, n, Vec3(-1, -1, 0.2)) - lookup(table, n, 0.625)).norm(), 1e-12);
}

TEST(AmcLookup, TheAppearanceMultipliesByOcclusion) {
  const AmcAppearance appearance(analytic_table(16, 8, 2));
  appearance::Surface surface;
  surface.eye_normal = Vec3(0.1, 0.2, 0.9).normalized();
  surface.tangent_angle = 0.3;
  const Vec3 open = appearance.evaluate(surface);
  surface.occlusion = 0.25;
  EXPECT_LT((appearance.evaluate(surface) - 0.25 * open).norm(), 1e-12);
  EXPECT_EQ(appearance.tangent_symmetry(), 2);
}

TEST(AmcTable, SlicesTurnIntoPicturesWithRowZeroOnTop) {
  const AmcTable table = analytic_table(16, 4, 1);
  const Image picture = slice_image(table, 1);
  EXPECT_EQ(picture.rgb(3, 0), table.texel(3, 15, 1));
  AmcTable copy(16, 4, 1);
  for (int f = 0; f < 4; ++f) set_slice_image(copy, f, slice_image(table, f));
  EXPECT_EQ(copy.texels, table.texels);
}

TEST(AmcTable, TheSheetCutsAlongXThenAlongY) {
  AmcTable table(16, 8, 1);
  for (int f = 0; f < 8; ++f) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x)
        table.set_texel(x, y, f, Vec3f(static_cast<float>(x), static_cast<float>(y), 0) / 16);
    }
  }
  const Image sheet = contact_sheet(table);
  // Within the last two of six tiles: from left to right only red grows, then only green.
  const auto growth = [&](double left, double right) {
    const int middle = sheet.height / 2;
    return Vec3f(sheet.rgb(static_cast<int>(right * sheet.width), middle) -
                 sheet.rgb(static_cast<int>(left * sheet.width), middle));
  };
  EXPECT_GT(growth(0.70, 0.80).x(), 0.4f);
  EXPECT_EQ(growth(0.70, 0.80).y(), 0);
  EXPECT_GT(growth(0.86, 0.96).y(), 0.4f);
  EXPECT_EQ(growth(0.86, 0.96).x(), 0);
}

TEST(AmcTable, TheIsotropicAverageIsTheMeanOverAllAngles) {
  // Over whole periods both lobes of the analytic material average to a half, and lobe^2 to 3/8.
  const AmcTable table = analytic_table(32, 16, 2);
  const Image mean = isotropic_average(table);
  const Vec2 disc = disc_of_pixel(10, 12, 32);
  const double diffuse = 0.25 + 0.15 * normal_on_disc(disc).dot(Vec3(0.3, 0.5, 0.8));
  EXPECT_NEAR(mean.at(10, 12, 0), diffuse + 0.15, 1e-3);
  EXPECT_NEAR(mean.at(10, 12, 1), diffuse + 0.2 * 0.375 + 0.025, 1e-3);
  EXPECT_NEAR(mean.at(10, 12, 2), diffuse + 0.125, 1e-3);
}

}  // namespace
}  // namespace sateen::amc
