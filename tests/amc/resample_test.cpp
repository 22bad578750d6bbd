// SPDX-License-Identifier: MIT
#include "sateen/amc/resample.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace sateen::amc {
namespace {

std::vector<double> even_angles(int count, double first = 0) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(first + static_cast<double>(i) / count);
  return angles;
}

double wave(double angle, int harmonic) {
  return std::cos(2 * std::numbers::pi * harmonic * angle + 0.4);
}

double resampled_wave(const std::vector<double>& angles, double angle, double spacing, int harmonic) {
  double value = 0;
  for (const auto& [frame, weight] : cyclic_weights(angles, angle, spacing)) {
    value += weight * wave(angles[static_cast<std::size_t>(frame)], harmonic);
  }
  return value;
}

TEST(Resample, FramesThatMatchSlicesAreTakenAlone) {
  const auto angles = even_angles(12);
  for (int i = 0; i < 12; ++i) {
    for (const double jitter : {-1e-14, 0.0, 1e-14}) {
      const FrameWeights weights = cyclic_weights(angles, i / 12.0 + jitter + 3, 1 / 12.0);
      double share = 0;
      for (const auto& [frame, weight] : weights) share += frame == i ? weight : 0;
      EXPECT_NEAR(share, 1, 1e-9) << i << " " << jitter;
    }
  }
}

TEST(Resample, WeightsSumToOneForAnyAngleAndSpacing) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> angles(static_cast<std::size_t>(2 + trial % 20));
    for (double& angle : angles) angle = uniform(random);
    std::ranges::sort(angles);
    double sum = 0;
    for (const auto& [frame, weight] : cyclic_weights(angles, 2 * uniform(random) - 1, 0.3 * uniform(random)))
      sum += weight;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(Resample, SparseFramesAreInterpolatedFarBetterThanLinearly) {
  // 32 frames, 3rd harmonic: linear interpolation errs by (2 pi 3 / 32)^2 / 8 = 0.043.
  const auto angles = even_angles(32, 0.01);
  double worst = 0;
  for (double a = 0; a < 1; a += 0.0037) {
    worst = std::max(worst, std::abs(resampled_wave(angles, a, 1.0 / 256, 3) - wave(a, 3)));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(Resample, UnevenAnglesAreInterpolatedWhereTheyReallyAre) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::vector<double> angles;
  for (int i = 0; i < 64; ++i) angles.push_back((i + 0.5 + jitter(random)) / 64);
  double worst = 0;
  for (double a = 0; a < 1; a += 0.0041) {
    worst = std::max(worst, std::abs(resampled_wave(angles, a, 1.0 / 256, 2) - wave(a, 2)));
  }
  EXPECT_LT(worst, 0.005);
}

TEST(Resample, DenseFramesAreAveragedSoThatNoiseFallsAndNothingAliases) {
  // 240 frames into 12 slices: the 11th harmonic would alias to the 1st; the tent keeps under 2 % of it.
  const auto angles = even_angles(240);
  for (int i = 0; i < 12; ++i) EXPECT_LT(std::abs(resampled_wave(angles, i / 12.0, 1 / 12.0, 11)), 0.02);
  double squares = 0;
  for (const auto& [frame, weight] : cyclic_weights(angles, 0, 1 / 12.0)) squares += weight * weight;
  EXPECT_LT(squares, 0.06);
}

TEST(Resample, ATurnTheOtherWayHasTheSameWeights) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> angles(static_cast<std::size_t>(4 + trial % 20));
    for (double& angle : angles) angle = uniform(random);
    std::ranges::sort(angles);
    std::vector<double> backwards;
    for (auto angle = angles.rbegin(); angle != angles.rend(); ++angle) backwards.push_back(1 - *angle);
    const double angle = uniform(random);
    const double spacing = 0.3 * uniform(random);
    std::vector<double> weights(angles.size());
    for (const auto& [frame, weight] : cyclic_weights(angles, angle, spacing))
      weights[static_cast<std::size_t>(frame)] += weight;
    for (const auto& [frame, weight] : cyclic_weights(backwards, -angle, spacing))
      weights[angles.size() - 1 - static_cast<std::size_t>(frame)] -= weight;
    for (const double difference : weights) EXPECT_NEAR(difference, 0, 1e-9);
  }
}

}  // namespace
}  // namespace sateen::amc
