// SPDX-License-Identifier: MIT
#include "sateen/core/view_transform.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sateen/core/colour.h"

namespace sateen {
namespace {

struct Published {
  Vec3 light;
  Vec3 neutral;
  Vec3 agx;
};

// What three.js 0.187 gives: the formulas and constants of its tonemapping_pars_fragment.glsl, evaluated in
// double precision by a script that reads that text.
const std::vector<Published> kThree{
    {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {{0.18, 0.18, 0.18}, {0.140000, 0.140000, 0.140000}, {0.214549, 0.214502, 0.214499}},
    {{1, 1, 1}, {0.869091, 0.869091, 0.869091}, {0.590229, 0.590136, 0.590102}},
    {{0.02, 0.02, 0.02}, {0.002500, 0.002500, 0.002500}, {0.018235, 0.018230, 0.018231}},
    {{16, 16, 16}, {0.996269, 0.996269, 0.996269}, {0.995212, 0.995098, 0.995009}},
    {{1e4, 1e4, 1e4}, {0.999994, 0.999994, 0.999994}, {0.996978, 0.996879, 0.996779}},
    {{0.8, 0.1, 0.05}, {0.765496, 0.065627, 0.015637}, {0.607619, 0.177156, 0.112525}},
    {{4, 0.3, 0.1}, {0.983256, 0.348143, 0.313812}, {1.000000, 0.473411, 0.341870}},
    {{0.05, 0.4, 2.5}, {0.182796, 0.295310, 0.970395}, {0.242917, 0.478837, 0.880020}},
    {{0.001, 0.6, 0.02}, {0.000006, 0.599006, 0.019006}, {0.141501, 0.458375, 0.089920}},
    {{30, 25, 0.2}, {0.998043, 0.966877, 0.812291}, {1.000000, 0.998747, 0.901260}},
    {{0.5, 0.04, 0.3}, {0.470000, 0.010000, 0.270000}, {0.457781, 0.120793, 0.318380}},
};

TEST(ViewTransform, NeutralIsThatOfThree) {
  for (const Published& p : kThree) {
    EXPECT_LT((shown_light(ViewTransform::neutral, p.light) - p.neutral).cwiseAbs().maxCoeff(), 1e-6)
        << p.light.transpose();
  }
}

// Its matrices to and from Rec. 2020 have four digits, ours nine.
TEST(ViewTransform, AgxIsThatOfThree) {
  for (const Published& p : kThree) {
    EXPECT_LT((shown_light(ViewTransform::agx, p.light) - p.agx).cwiseAbs().maxCoeff(), 3e-4)
        << p.light.transpose() << " gives " << shown_light(ViewTransform::agx, p.light).transpose();
  }
}

TEST(ViewTransform, NeutralKeepsWhatItDoesNotCompressButForTheReflectance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> channel(0.08, 0.79);
  for (int i = 0; i < 200; ++i) {
    const Vec3 light(channel(random), channel(random), channel(random));
    EXPECT_LT((shown_light(ViewTransform::neutral, light) - (light - Vec3::Constant(0.04))).norm(), 1e-12);
  }
}

TEST(ViewTransform, NeutralKeepsTheHue) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> stops(-6, 8);
  for (int i = 0; i < 500; ++i) {
    const Vec3 light(std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random)));
    const Vec3 shown = shown_light(ViewTransform::neutral, light);
    double apart = std::abs(rgb_to_hsv(shown)[0] - rgb_to_hsv(light)[0]);
    apart = std::min(apart, 1 - apart);
    EXPECT_LT(apart, 1e-9) << light.transpose();
  }
}

TEST(ViewTransform, GreysStayGreyAndOnlyGrowTowardsWhite) {
  for (const ViewTransform view :
       {ViewTransform::none, ViewTransform::srgb, ViewTransform::neutral, ViewTransform::agx}) {
    double before = -1;
    for (double stops = -14; stops < 12; stops += 0.05) {
      const Vec3 shown = shown_light(view, Vec3::Constant(std::exp2(stops)));
      EXPECT_LT(shown.maxCoeff() - shown.minCoeff(), 1e-6) << stops;
      EXPECT_GE(shown.minCoeff(), std::max(0.0, before - 1e-12)) << stops;
      EXPECT_LE(shown.maxCoeff(), 1.0) << stops;
      before = shown.minCoeff();
    }
    EXPECT_GT(before, 0.996);
  }
}

TEST(ViewTransform, LightIsShownBetweenBlackAndWhiteWhateverItIs) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const ViewTransform view :
       {ViewTransform::none, ViewTransform::srgb, ViewTransform::neutral, ViewTransform::agx}) {
    for (const Vec3& light : {Vec3(-1, -2, -3), Vec3(infinite, 0, 1), Vec3(infinite, infinite, infinite),
                              Vec3(0, 0, 1e300), Vec3(-5, 7, 0.1)}) {
      const Vec3 shown = shown_light(view, light);
      EXPECT_TRUE(shown.allFinite()) << light.transpose();
      EXPECT_GE(shown.minCoeff(), 0) << light.transpose();
      EXPECT_LE(shown.maxCoeff(), 1) << light.transpose();
    }
  }
}

TEST(ViewTransform, SrgbAndNoneOnlyClamp) {
  const Vec3 light(-0.5, 0.25, 3);
  EXPECT_EQ(shown_light(ViewTransform::srgb, light), Vec3(0, 0.25, 1));
  EXPECT_EQ(shown_light(ViewTransform::none, light), Vec3(0, 0.25, 1));
}

}  // namespace
}  // namespace sateen
