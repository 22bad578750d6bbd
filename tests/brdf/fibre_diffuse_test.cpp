// SPDX-License-Identifier: MIT
#include "sateen/brdf/fibre_diffuse.h"

#include <gtest/gtest.h>

#include "brdf/random_directions.h"

namespace sateen::brdf {
namespace {

using test::random_unit;

/// (1/pi) of max(0, n'.l) summed over the fibre's upper half by the midpoint rule.
double summed(const Vec3& light) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double a = kPi * ((i + 0.5) / kSteps - 0.5);
    sum += std::max(0.0, light.z() * std::cos(a) + light.y() * std::sin(a));
  }
  return sum / kSteps;
}

TEST(FibreDiffuse, ClosedFormIsTheIntegralEverywhereAboveTheHorizon) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    Vec3 light = random_unit(random);
    light.z() = std::abs(light.z());
    EXPECT_NEAR(fibre_diffuse(light), fibre_diffuse_integral(light), 1e-9) << light.transpose();
    if (i % 100 == 0) {
      EXPECT_NEAR(fibre_diffuse(light), summed(light), 1e-6) << light.transpose();
    }
  }
}

TEST(FibreDiffuse, KnownDirections) {
  EXPECT_DOUBLE_EQ(fibre_diffuse({0, 0, 1}), 2 / kPi);
  EXPECT_DOUBLE_EQ(fibre_diffuse({1, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(fibre_diffuse({-1, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(fibre_diffuse({0, 1, 0}), 1 / kPi);
  EXPECT_DOUBLE_EQ(fibre_diffuse({0, -1, 0}), 1 / kPi);
  EXPECT_DOUBLE_EQ(fibre_diffuse({0, 0.6, -0.8}), 0);
  // The integral itself stays positive below the horizon: that is why the light is clamped there.
  EXPECT_GT(fibre_diffuse_integral({0, 0.6, -0.8}), 0.05);
}

TEST(FibreDiffuse, ThePrintedFormIsRightForHalfTheLightsOnly) {
  std::mt19937 random(2);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 light = test::random_up(random);
    const double error = std::abs(fibre_diffuse_printed(light) - fibre_diffuse(light));
    if (light.x() > 0) {
      EXPECT_LT(error, 1e-12);
    }
    worst = std::max(worst, error);
  }
  EXPECT_NEAR(worst, 2 / kPi, 0.02);
}

TEST(FibreDiffuse, NoDirectionGivesNaN) {
  for (const double x : {-1.0, -1e-300, 0.0, 1e-300, 1.0}) {
    for (const double y : {-1.0, 0.0, 1e-300, 1.0}) {
      for (const double z : {-1.0, 0.0, 1e-300, 1.0}) {
        const Vec3 v(x, y, z);
        if (v.norm() == 0) continue;
        const Vec3 light = v.normalized();
        EXPECT_TRUE(std::isfinite(fibre_diffuse(light)));
        EXPECT_TRUE(std::isfinite(fibre_diffuse_printed(light)));
        EXPECT_TRUE(std::isfinite(fibre_diffuse_integral(light)));
        EXPECT_TRUE(std::isfinite(fibre_maximum_normal(light)));
      }
    }
  }
}

TEST(FibreDiffuse, MomentsOfTheMaximumNormalAreTheIntegralsTheyName) {
  const auto moment = [](auto weight) {
    return test::midpoint_hemisphere([&](const Vec3& l) { return fibre_maximum_normal(l) * weight(l); }, 500);
  };
  EXPECT_NEAR(kMaximumNormalMoments.one, moment([](const Vec3&) { return 1.0; }), 1e-4);
  EXPECT_NEAR(kMaximumNormalMoments.z, moment([](const Vec3& l) { return l.z(); }), 1e-4);
  EXPECT_NEAR(kMaximumNormalMoments.xx, moment([](const Vec3& l) { return l.x() * l.x(); }), 1e-4);
  EXPECT_NEAR(kMaximumNormalMoments.yy, moment([](const Vec3& l) { return l.y() * l.y(); }), 1e-4);
  EXPECT_NEAR(kMaximumNormalMoments.zz, moment([](const Vec3& l) { return l.z() * l.z(); }), 1e-4);
}

TEST(FibreDiffuse, MomentsAreTheIntegralsTheyName) {
  const auto moment = [](auto weight) {
    return test::midpoint_hemisphere([&](const Vec3& l) { return fibre_diffuse(l) * weight(l); }, 500);
  };
  EXPECT_NEAR(kFibreDiffuseNorm, moment([](const Vec3&) { return 1.0; }), 1e-5);
  EXPECT_NEAR(kFibreMoments.one, kFibreDiffuseNorm, 1e-15);
  EXPECT_NEAR(kFibreMoments.z, moment([](const Vec3& l) { return l.z(); }), 1e-5);
  EXPECT_NEAR(kFibreMoments.xx, moment([](const Vec3& l) { return l.x() * l.x(); }), 1e-5);
  EXPECT_NEAR(kFibreMoments.yy, moment([](const Vec3& l) { return l.y() * l.y(); }), 1e-5);
  EXPECT_NEAR(kFibreMoments.zz, moment([](const Vec3& l) { return l.z() * l.z(); }), 1e-5);
}

}  // namespace
}  // namespace sateen::brdf
