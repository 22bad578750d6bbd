// SPDX-License-Identifier: MIT
#include "sateen/light/default_lighting.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sateen/core/colour.h"
#include "sateen/light/environment.h"

namespace sateen::light {
namespace {

/// Radiance of a white diffuse surface: lamps, and the sky summed pixel by pixel.
double white_radiance(const DefaultLighting& lighting, const Vec3& normal) {
  double irradiance = 0;
  for (const PunctualLight& lamp : lighting.lamps) {
    irradiance += luminance(lamp.colour) * std::max(0.0, normal.dot(lamp.direction));
  }
  const Image& sky = lighting.sky;
  for (int y = 0; y < sky.height; ++y) {
    const double band = kPi * (0.5 - (y + 0.5) / sky.height);
    const double solid_angle = std::cos(band) * kPi / sky.height * 2 * kPi / sky.width;
    for (int x = 0; x < sky.width; ++x) {
      const Vec3 from = environment_direction({(x + 0.5) / sky.width, (y + 0.5) / sky.height});
      irradiance += luminance(sky.rgb(x, y).cast<double>()) * std::max(0.0, normal.dot(from)) * solid_angle;
    }
  }
  return irradiance / kPi;
}

TEST(DefaultLighting, AGreyCardIsMiddleGrey) {
  EXPECT_NEAR(white_radiance(default_lighting(), Vec3::UnitZ()), 1, 0.05);
}

TEST(DefaultLighting, NoVisibleSurfaceIsBlackOrBurnt) {
  const DefaultLighting lighting = default_lighting();
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j < 24; ++j) {
      const double from_view = kPi / 2 * i / 8;
      const double around = 2 * kPi * j / 24;
      const Vec3 normal(std::sin(from_view) * std::cos(around), std::sin(from_view) * std::sin(around),
                        std::cos(from_view));
      const double radiance = white_radiance(lighting, normal);
      EXPECT_GT(radiance, 1.0 / 6) << normal.transpose();
      EXPECT_LT(radiance, 2) << normal.transpose();
    }
  }
}

TEST(DefaultLighting, TheKeyStandsInFrontAndTheRimLightBehind) {
  const DefaultLighting lighting = default_lighting();
  ASSERT_EQ(lighting.lamps.size(), 2U);
  const Vec3 key = lighting.lamps[0].direction;
  const Vec3 rim = lighting.lamps[1].direction;
  EXPECT_NEAR(key.norm(), 1, 1e-12);
  EXPECT_NEAR(rim.norm(), 1, 1e-12);
  EXPECT_TRUE(key.x() < 0 && key.y() > 0 && key.z() > 0) << key.transpose();
  EXPECT_TRUE(rim.x() > 0 && rim.y() > 0 && rim.z() < 0) << rim.transpose();
}

TEST(DefaultLighting, TheSkyIsSoftAndBrighterAboveThanBelow) {
  const Image sky = default_lighting().sky;
  ASSERT_EQ(sky.width, 2 * sky.height);
  EXPECT_GT(sky.rgb(64, 0).minCoeff(), 2 * sky.rgb(64, 63).maxCoeff());
  for (int y = 0; y < sky.height; ++y) {
    for (int x = 0; x < sky.width; ++x) {
      EXPECT_GT(sky.rgb(x, y).minCoeff(), 0.1);
      EXPECT_LT(sky.rgb(x, y).maxCoeff(), 2);
      const Vec3f step = sky.rgb((x + 1) % sky.width, y) - sky.rgb(x, y);
      EXPECT_LT(step.cwiseAbs().maxCoeff(), 0.15) << x << ", " << y;  // no edges, none at the seam
    }
  }
}

}  // namespace
}  // namespace sateen::light
