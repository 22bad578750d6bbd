// SPDX-License-Identifier: MIT
#include "sateen/light/environment.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "brdf/random_directions.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"
#include "sateen/light/environment_sampler.h"
#include "sateen/light/lighting.h"
#include "sateen/light/prefiltered.h"
#include "sateen/light/punctual.h"
#include "sateen/light/spherical_harmonics.h"
#include "support/files.h"

namespace sateen::light {
namespace {

using test::random_unit;

Image filled(int width, const std::function<Vec3(const Vec3&)>& radiance) {
  Image image(width, width / 2, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.set_rgb(
          x, y,
          radiance(environment_direction({(x + 0.5) / image.width, (y + 0.5) / image.height})).cast<float>());
    }
  }
  return image;
}

TEST(Environment, DirectionsAndTexturePointsAreInverse) {
  EXPECT_LT((environment_direction({0.5, 0.5}) - Vec3(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((environment_direction({0.75, 0.5}) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((environment_direction({0.3, 0}) - Vec3(0, 1, 0)).norm(), 1e-12);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = random_unit(random);
    EXPECT_LT((environment_direction(environment_uv(d)) - d).norm(), 1e-9);
  }
}

TEST(Environment, BilinearLookupWrapsAroundAndIsExactForConstants) {
  const Image constant = filled(16, [](const Vec3&) { return Vec3(1, 2, 3); });
  const Image smooth = filled(256, [](const Vec3& d) { return Vec3(2 + d.x(), 2 + d.y(), 2 + d.z()); });
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = random_unit(random);
    EXPECT_LT((environment_radiance(constant, d) - Vec3(1, 2, 3)).norm(), 1e-6);
    EXPECT_LT((environment_radiance(smooth, d) - (Vec3(2, 2, 2) + d)).norm(), 0.02);
  }
  const double e = 1e-6;
  EXPECT_LT((environment_radiance(smooth, Vec3(e, 0, 1).normalized()) -
             environment_radiance(smooth, Vec3(-e, 0, 1).normalized()))
                .norm(),
            1e-3);
}

TEST(Environment, RefusesPicturesOfAnotherShapeAndClampsNegatives) {
  const test::TemporaryFolder folder;
  io::write_image(folder / "square.exr", Image(8, 8, 3, 1));
  EXPECT_THAT([&] { read_environment(folder / "square.exr"); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr("square.exr"), testing::HasSubstr("8 x 8"))));
  io::write_image(folder / "negative.exr", Image(8, 4, 3, -1));
  EXPECT_EQ(read_environment(folder / "negative.exr").at(3, 2, 1), 0);
}

TEST(EnvironmentSampler, SamplesFollowTheirDensityAndEstimateIrradiance) {
  const Image sky = filled(32, [](const Vec3& d) {
    return Vec3::Constant(0.1 + (d.dot(Vec3(0.6, 0.7, -0.3).normalized()) > 0.9 ? 50 : 0)).eval();
  });
  const EnvironmentSampler sampler(sky);
  std::mt19937 random(3);
  constexpr int kSamples = 100000;
  std::vector<double> observed(32 * 16, 0);
  double irradiance = 0;
  const Vec3 normal = Vec3(0.2, 0.9, 0).normalized();
  for (int i = 0; i < kSamples; ++i) {
    const auto sample = sampler.sample({test::random_in(random, 0, 1), test::random_in(random, 0, 1)});
    EXPECT_NEAR(sampler.pdf(sample.direction) / sample.pdf, 1, 1e-6);
    const Vec2 uv = environment_uv(sample.direction);
    const int x = std::min(31, static_cast<int>(uv.x() * 32));
    const int y = std::min(15, static_cast<int>(uv.y() * 16));
    observed[static_cast<std::size_t>(y * 32 + x)] += 1;
    irradiance += sky.at(x, y, 0) * std::max(0.0, normal.dot(sample.direction)) / sample.pdf / kSamples;
  }
  double chi_squared = 0;
  int cells = 0;
  double exact = 0;
  for (int y = 0; y < 16; ++y) {
    const double solid_angle = 2 * kPi / 32 * (std::cos(kPi * y / 16) - std::cos(kPi * (y + 1) / 16));
    for (int x = 0; x < 32; ++x) {
      const Vec3 d = environment_direction({(x + 0.5) / 32, (y + 0.5) / 16});
      const double expected = sampler.pdf(d) * solid_angle * kSamples;
      exact += sky.at(x, y, 0) * std::max(0.0, normal.dot(d)) * solid_angle;
      if (expected < 5) continue;
      const double seen = observed[static_cast<std::size_t>(y * 32 + x)];
      chi_squared += (seen - expected) * (seen - expected) / expected;
      ++cells;
    }
  }
  EXPECT_GT(cells, 10);
  EXPECT_LT(chi_squared, cells + 4 * std::sqrt(2.0 * cells));
  EXPECT_NEAR(irradiance / exact, 1, 0.02);
}

TEST(EnvironmentSampler, NegativeLightIsNeverDrawn) {
  Image sky(8, 4, 3, 1);
  for (int x = 0; x < 8; ++x) sky.set_rgb(x, 1, Vec3f::Constant(-2));
  const EnvironmentSampler sampler(sky);
  EXPECT_EQ(sampler.pdf(environment_direction({0.3, 0.4})), 0);
  // Evenly over the three other rows.
  const double solid_angle = 4 * kPi * (1 - std::cos(kPi / 4) / 2);
  EXPECT_NEAR(sampler.pdf(environment_direction({0.3, 0.9})), 1 / solid_angle, 1e-12);
  EXPECT_NEAR(sampler.sample({0.5, 0.5}).pdf, 1 / solid_angle, 1e-12);
}

TEST(SphericalHarmonics, ReproduceTheirOwnPolynomialsAndTheirIrradiance) {
  std::mt19937 random(4);
  SphericalHarmonics9 light;
  for (Vec3& c : light.c) c = random_unit(random);
  light.c[0] = Vec3::Constant(4);
  const Image image = filled(128, [&](const Vec3& d) { return light.radiance(d); });
  const SphericalHarmonics9 back = project_environment(image);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_LT((back.c[i] - light.c[i]).norm(), 5e-3) << i;
  const Vec3 n = random_unit(random);
  const Mat3 frame = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), n).toRotationMatrix();
  for (int channel = 0; channel < 3; ++channel) {
    const double summed = test::midpoint_hemisphere(
        [&](const Vec3& d) { return light.radiance(frame * d)[channel] * d.z(); }, 200);
    EXPECT_NEAR(light.irradiance(n)[channel], summed, 1e-3);
    const double mean =
        test::midpoint_hemisphere([&](const Vec3& d) { return light.radiance(frame * d)[channel]; }, 200);
    EXPECT_NEAR(light.hemisphere_mean(n)[channel], mean / (2 * kPi), 1e-3);
  }
}

TEST(SphericalHarmonics, TurnWithTheFrame) {
  std::mt19937 random(5);
  SphericalHarmonics9 light;
  for (Vec3& c : light.c) c = random_unit(random);
  const Mat3 rotation = Eigen::AngleAxisd(1.1, random_unit(random)).toRotationMatrix();
  const SphericalHarmonics9 turned = rotated(light, rotation);
  for (int i = 0; i < 50; ++i) {
    const Vec3 d = random_unit(random);
    EXPECT_LT((turned.radiance(rotation * d) - light.radiance(d)).norm(), 1e-12);
  }
}

TEST(Prefiltered, KeepsConstantLightAndBlursWithGgx) {
  const PrefilteredEnvironment even(filled(64, [](const Vec3&) { return Vec3(1, 2, 3); }), 64, 64);
  EXPECT_EQ(even.levels(), 2);
  EXPECT_LT((even.radiance(Vec3(0.1, 0.9, 0.3).normalized(), 0.5) - Vec3(1, 2, 3)).norm(), 5e-3);
  // A smooth sky against direct integration of the lobe, at the alphas of the levels below the first. Two
  // errors shrink with resolution: lookups between the 32 x 16 texels of the last level (none at their
  // middles), and the width of the texels that stand for one sample's share (less with more samples).
  const auto sky = [](const Vec3& d) { return Vec3(1 + d.y(), std::exp(2 * d.x()), 1 + d.z() * d.z()); };
  const Image light = filled(256, sky);
  const auto error = [&](const PrefilteredEnvironment& blurred, const Vec3& axis, double alpha) {
    const Mat3 frame = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
    double largest = 0;
    for (int channel = 0; channel < 3; ++channel) {
      double total = 0;
      const double sum = test::midpoint_hemisphere(
          [&](const Vec3& l) {
            const double c = (l + Vec3::UnitZ()).normalized().z();
            const double q = c * c * (alpha * alpha - 1) + 1;
            const double weight = alpha * alpha / (q * q) * l.z();
            total += weight;
            return weight * sky(frame * l)[channel];
          },
          200);
      const double expected = sum / (total * kPi / 40000);
      largest = std::max(largest, std::abs(blurred.radiance(axis, alpha)[channel] / expected - 1));
    }
    return largest;
  };
  const PrefilteredEnvironment coarse(light, 128, 256);
  const PrefilteredEnvironment fine(light, 128, 1024);
  const Vec3 middle = environment_direction({21.5 / 32, 5.5 / 16});
  for (const double alpha : {1.0, 0.25}) {
    EXPECT_LT(error(fine, middle, alpha), 0.01) << alpha;
    EXPECT_LT(error(coarse, Vec3(0.5, 0.4, -0.6).normalized(), alpha), 0.04) << alpha;
  }
}

TEST(Prefiltered, ASunIsFiniteAndTheTextureGoesRound) {
  const PrefilteredEnvironment map(
      filled(64, [](const Vec3& d) { return Vec3(d.y() > 0.9 ? 1e6 : 1, 1, 1); }), 64, 16);
  EXPECT_EQ(map.radiance(Vec3::UnitY(), 0).x(), 65504);
  EXPECT_EQ(map.texture()->wrap_u, TextureData::Wrap::repeat);
  EXPECT_EQ(map.texture()->wrap_v, TextureData::Wrap::clamp);
}

TEST(Surroundings, TurnCounterClockwiseWithTheirHarmonics) {
  // Red behind, green on the right.
  const Surroundings sky = make_surroundings(
      filled(64, [](const Vec3& d) { return Vec3(std::max(0.0, -d.z()), std::max(0.0, d.x()), 0); }));
  const Surroundings quarter = turned(sky, turn_about_vertical(kPi / 2));
  for (const double alpha : {0.0, 0.5}) {
    // What was behind is on the left, what was on the right is behind.
    EXPECT_GT(quarter.radiance({-1, 0, 0}, alpha).x(), 0.5) << alpha;
    EXPECT_GT(quarter.radiance({0, 0, -1}, alpha).y(), 0.5) << alpha;
    EXPECT_LT(quarter.radiance({1, 0, 0}, alpha).maxCoeff(), 0.3) << alpha;
  }
  EXPECT_LT((quarter.harmonics.irradiance({-1, 0, 0}) - sky.harmonics.irradiance({0, 0, -1})).norm(), 1e-9);
  EXPECT_LT((quarter.harmonics.irradiance({0, 0, -1}) - sky.harmonics.irradiance({1, 0, 0})).norm(), 1e-9);
}

TEST(Prefiltered, TextureRowsRunUpwards) {
  const PrefilteredEnvironment map(filled(64, [](const Vec3& d) { return Vec3(d.y() > 0 ? 1 : 0, 0, 0); }),
                                   64, 16);
  const auto texture = map.texture();
  ASSERT_EQ(texture->levels.size(), 2U);
  EXPECT_EQ(texture->levels[0].size(), 64U * 32 * 8);
  const auto* texels = reinterpret_cast<const Half*>(texture->levels[0].data());
  EXPECT_EQ(static_cast<float>(texels[0]), 0);
  EXPECT_EQ(static_cast<float>(texels[31 * 64 * 4]), 1);
}

TEST(Punctual, InverseSquareAndCone) {
  PunctualLight light;
  light.kind = PunctualLight::Kind::point;
  light.position = {0, 0, 2};
  light.colour = {4, 8, 12};
  const ArrivingLight arriving = arriving_light(light, Vec3::Zero());
  EXPECT_LT((arriving.direction - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((arriving.irradiance - Vec3(1, 2, 3)).norm(), 1e-12);
  light.kind = PunctualLight::Kind::spot;
  light.direction = {0, 0, -1};
  light.inner_cone = 0.2;
  light.outer_cone = 0.4;
  EXPECT_LT((arriving_light(light, Vec3::Zero()).irradiance - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(arriving_light(light, {5, 0, 0}).irradiance.norm(), 0);
  // Between the cones the cosine goes on from one to the other, and counts squared.
  const double angle = 0.3;
  const double share = (std::cos(angle) - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4));
  EXPECT_NEAR(arriving_light(light, {2 * std::tan(angle), 0, 0}).irradiance.y(),
              2 * std::pow(std::cos(angle), 2) * share * share, 1e-12);
}

}  // namespace
}  // namespace sateen::light
