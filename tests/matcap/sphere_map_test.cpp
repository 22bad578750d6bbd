// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_map.h"

#include <gtest/gtest.h>

#include "sateen/matcap/blind_spot.h"
#include "sateen/matcap/sharpen.h"
#include "sateen/matcap/sphere_blur.h"
#include "sateen/matcap/unwarp.h"
#include "sateen/matcap/warp.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

SphereMap gaussian_map(int size, const Vec3& centre, double variance) {
  return make_sphere_map(size, [&](const Vec3& w) -> Vec3 {
    const double angle = test::angle_between(w, centre);
    return Vec3::Constant(std::exp(-angle * angle / (2 * variance)));
  });
}

/// Variance along one axis of what is bright around `centre`, from values within `reach`.
double spread(const SphereMap& map, const Vec3& centre, double reach) {
  double sum = 0;
  double sum2 = 0;
  for (const bool back : {false, true}) {
    for (int y = 0; y < map.size(); ++y) {
      for (int x = 0; x < map.size(); ++x) {
        const Vec2 t(2 * (x + 0.5) / map.size() - 1, 1 - 2 * (y + 0.5) / map.size());
        if (t.squaredNorm() > 1) continue;
        const double angle = test::angle_between(direction_of_map(t, back), centre);
        if (angle > reach) continue;
        const double area = 4 / ((1 + t.squaredNorm()) * (1 + t.squaredNorm()));
        const double weight = area * (back ? map.back : map.front).at(x, y, 0);
        sum += weight;
        sum2 += weight * angle * angle / 2;
      }
    }
  }
  return sum2 / sum;
}

TEST(Warp, MultipliesTheAngleAndBackAgain) {
  EXPECT_NEAR(slope_of_variance(0), 1, 1e-12);
  EXPECT_NEAR(slope_of_variance(0.5), 1 - 0.15 - 0.275, 1e-12);
  EXPECT_EQ(slope_of_variance(2), 0);
  const Vec3 n = test::direction_at(0.6, 2);
  EXPECT_TRUE(warp(n, 1).isApprox(Vec3(2 * n.z() * n - Vec3::UnitZ())));  // the mirror direction
  EXPECT_TRUE(warp(n, 0).isApprox(n));
  EXPECT_TRUE(unwarp(warp(n, 0.4), 0.4).isApprox(n));
  EXPECT_TRUE(warp(Vec3::UnitZ(), 0.7).isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(test::angle_between(warp(test::direction_at(kPi / 2, 1), 0.4), -Vec3::UnitZ()),
              blind_spot_angle(0.4), 1e-12);
}

TEST(SphereMap, LookupsGiveASmoothFunctionBackEverywhere) {
  const auto function = [](const Vec3& w) -> Vec3 {
    return {1 + w.x() * w.y(), 1 + w.z(), 1 + w.x() * w.z()};
  };
  const SphereMap map = make_sphere_map(128, function);
  double worst = 0;
  for (double theta = 0.01; theta < kPi; theta += 0.05) {
    for (double azimuth = 0; azimuth < 6; azimuth += 0.1) {
      const Vec3 w = test::direction_at(theta, azimuth);
      worst = std::max(worst, (sample(map, w) - function(w)).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(worst, 1e-3);  // also across the equator
  // The texture coordinate of the paper.
  const Vec3 w = test::direction_at(2, 1);
  EXPECT_TRUE(map_of_direction(w).isApprox(w.head<2>() / (1 + std::abs(w.z()))));
  EXPECT_TRUE(direction_of_map(map_of_direction(w), true).isApprox(w));
}

TEST(SphereBlur, KeepsConstantsAndAddsVariances) {
  const SphereMap flat = make_sphere_map(64, [](const Vec3&) -> Vec3 { return {0.2, 0.4, 0.6}; });
  const SphereMap still = blurred(flat, 0.02, 64);
  for (const float v : still.front.data)
    EXPECT_TRUE(std::abs(v - 0.2F) < 1e-5 || std::abs(v - 0.4F) < 1e-5 || std::abs(v - 0.6F) < 1e-5);
  // In front, on the equator (both maps), and behind.
  for (const double theta : {0.0, kPi / 2, 2.6}) {
    const Vec3 centre = test::direction_at(theta, 0.5);
    const SphereMap map = gaussian_map(128, centre, 0.01);
    const double before = spread(map, centre, 0.9);
    EXPECT_NEAR(spread(blurred(map, 0.02, 128), centre, 0.9) - before, 0.02, 0.001) << theta;
    const PrefilteredMap levels = prefilter(map);
    EXPECT_NEAR(spread(blurred(levels, 0.02), centre, 0.9) - before, 0.02, 0.0015) << theta;
    const SphereMap looked_up = make_sphere_map(128, [&](const Vec3& w) { return sample(levels, w, 0.02); });
    EXPECT_NEAR(spread(looked_up, centre, 0.9) - before, 0.02, 0.003) << theta;
  }
}

TEST(SphereBlur, LevelsInterpolateLinearlyInVariance) {
  const std::vector<double> variances{0, 0.01, 0.04};
  EXPECT_DOUBLE_EQ(level_of_variance(variances, 0), 0);
  EXPECT_DOUBLE_EQ(level_of_variance(variances, 0.005), 0.5);
  EXPECT_DOUBLE_EQ(level_of_variance(variances, 0.025), 1.5);
  EXPECT_DOUBLE_EQ(level_of_variance(variances, 1), 2);
}

TEST(Sharpened, UndoesABlurWithoutRaisingGrain) {
  const Vec3 centre = test::direction_at(0.8, 1);
  SphereMap map = gaussian_map(128, centre, 0.03);
  const double before = spread(map, centre, 0.9);
  EXPECT_NEAR(before - spread(sharpened(map, 0.012), centre, 0.9), 0.012, 0.003);
  EXPECT_NEAR(sample(sharpened(map, 0.012), centre).x(), 0.03 / 0.018,
              0.12);  // a Gaussian's peak, its energy kept

  // Grain on a flat field: deconvolution leaves it, a sharpening mask of the same strength raises it.
  unsigned state = 5;
  SphereMap grain = make_sphere_map(128, [](const Vec3&) -> Vec3 { return Vec3::Constant(0.5); });
  for (Image* image : {&grain.front, &grain.back}) {
    for (float& v : image->data) {
      state = state * 1664525U + 1013904223U;
      v += 0.04F * (static_cast<float>(state >> 8) / 16777216.0F - 0.5F);
    }
  }
  const auto deviation = [](const SphereMap& m) {
    double sum = 0;
    double sum2 = 0;
    for (const float v : m.front.data) {
      sum += v;
      sum2 += static_cast<double>(v) * v;
    }
    const double n = static_cast<double>(m.front.data.size());
    return std::sqrt(sum2 / n - sum * sum / (n * n));
  };
  const SphereMap blurry = blurred(grain, 0.012, 128);
  SphereMap mask = grain;
  for (std::size_t i = 0; i < mask.front.data.size(); ++i)
    mask.front.data[i] += mask.front.data[i] - blurry.front.data[i];
  EXPECT_LT(deviation(sharpened(grain, 0.012)), 1.1 * deviation(grain));
  EXPECT_GT(deviation(mask), 1.8 * deviation(grain));
}

// A harmonic function needs no guide: the fill must give it back inside from its boundary alone.
TEST(BlindSpot, SolvesLaplacesEquation) {
  const double angle = 0.5;
  const double radius = std::tan(angle / 2);
  const auto harmonic = [&](double r, double azimuth) {
    return 2 + 0.5 * std::pow(r / radius, 3) * std::cos(3 * azimuth);
  };
  // The same colour beyond the edge: no slope, no guide.
  const BlindSpot spot(
      angle, [&](double, double azimuth) -> Vec3 { return Vec3::Constant(harmonic(radius, azimuth)); });
  for (double r = 0; r < radius; r += radius / 11) {
    for (double azimuth = 0.05; azimuth < 6.2; azimuth += 0.4) {
      const Vec3 w = direction_of_map(r * Vec2(std::cos(azimuth), std::sin(azimuth)), true);
      EXPECT_NEAR(spot(w).x(), harmonic(r, azimuth), 0.01) << r / radius;
    }
  }
}

TEST(BlindSpot, NoiseOnTheBoundaryMakesNoStreaksToTheCentre) {
  unsigned state = 3;
  std::vector<double> noise(4096);
  for (double& v : noise) {
    state = state * 1664525U + 1013904223U;
    v = static_cast<double>(state >> 8) / 16777216.0;
  }
  const BlindSpot spot(0.6, [&](double, double azimuth) -> Vec3 {
    return Vec3::Constant(1 + noise[static_cast<std::size_t>(azimuth / (2 * kPi) * 4095)]);
  });
  const double radius = std::tan(0.3);
  double least = 1e9;
  double most = -1e9;
  for (double azimuth = 0; azimuth < 6.28; azimuth += 0.01) {
    const double v =
        spot(direction_of_map(0.5 * radius * Vec2(std::cos(azimuth), std::sin(azimuth)), true)).x();
    least = std::min(least, v);
    most = std::max(most, v);
  }
  EXPECT_LT(most - least, 0.2);  // of noise that spans 1
}

TEST(BlindSpot, ArrivesWithTheSlopeOutside) {
  const double angle = 0.6;
  const double radius = std::tan(angle / 2);
  const double slope = 2;  // rises outwards, per unit of the map
  const BlindSpot spot(angle, [&](double beyond, double) -> Vec3 {
    return Vec3::Constant(1 + slope * (std::tan((angle + beyond) / 2) - radius));
  });
  const auto at = [&](double r) { return spot(direction_of_map({r, 0}, true)).x(); };
  EXPECT_NEAR((at(radius) - at(0.96 * radius)) / (0.04 * radius), slope, 0.5);
  EXPECT_NEAR(at(0), at(0.2 * radius), 0.02);
}

TEST(Unwarp, GivesTheComponentBackAtThePixelsAndIsSmoothPastTheRim) {
  const int size = 96;
  const Disc disc = inscribed_disc(size, size);
  const Image component = test::sphere_picture(size, [](const Vec3& n) -> Vec3 {
    return {0.5 + 0.4 * n.x(), std::exp(-20 * (n - Vec3(0.6, 0, 0.8)).squaredNorm()),
            0.2 + 0.5 * n.y() * n.y()};
  });
  for (const double slope : {0.6, 0.99}) {
    const SphereMap map = unwarp_to_sphere(component, disc, slope, size);
    EXPECT_LT(unwarp_error(map, component, disc, slope), 1e-3);
    if (slope > 0.9) continue;  // the blind spot is a point
    const double edge = kPi - blind_spot_angle(slope);
    for (double azimuth = 0; azimuth < 6; azimuth += 0.5) {
      const Vec3 inside = sample(map, test::direction_at(edge + 0.02, azimuth));
      const Vec3 outside = sample(map, test::direction_at(edge - 0.02, azimuth));
      EXPECT_LT((inside - outside).cwiseAbs().maxCoeff(), 0.12);
    }
  }
}

}  // namespace
}  // namespace sateen::matcap
