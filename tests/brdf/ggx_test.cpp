// SPDX-License-Identifier: MIT
#include "sateen/brdf/ggx.h"

#include <gtest/gtest.h>

#include "brdf/random_directions.h"

namespace sateen {
namespace {

using test::random_in;
using test::random_up;

AnisotropicRoughness random_roughness(std::mt19937& random, double lowest = 0.05) {
  return {random_in(random, lowest, 1), random_in(random, lowest, 1), random_in(random, 0, kPi)};
}

TEST(Ggx, DistributionIsNormalised) {
  std::mt19937 random(1);
  for (int i = 0; i < 8; ++i) {
    const AnisotropicRoughness r = random_roughness(random, 0.15);
    EXPECT_NEAR(test::midpoint_hemisphere([&](const Vec3& h) { return ggx_distribution(r, h) * h.z(); }, 400),
                1, 2e-3);
  }
}

TEST(Ggx, MatrixAndAxesAreTheSameRoughness) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    AnisotropicRoughness r = random_roughness(random);
    const Mat2 matrix = roughness_matrix(r);
    const AnisotropicRoughness back = roughness_from_matrix(matrix);
    EXPECT_GE(back.alpha_t, back.alpha_b);
    EXPECT_LT((roughness_matrix(back) - matrix).norm(), 1e-12);
    // The slides' D(h) from the matrix: 1 / (pi sqrt|S| (h^T S^-1 h)^2) with S completed by 1 along the
    // normal.
    const Vec3 h = random_up(random);
    const double q = h.head<2>().dot(matrix.inverse() * h.head<2>()) + h.z() * h.z();
    EXPECT_NEAR(ggx_distribution(r, h) * kPi * std::sqrt(matrix.determinant()) * q * q, 1, 1e-9);
  }
}

TEST(Ggx, IndefiniteMatricesAreGuarded) {
  Mat2 broken;
  broken << 0.04, 0.2, 0.2, 0.01;
  const AnisotropicRoughness r = roughness_from_matrix(broken);
  EXPECT_GE(r.alpha_b, kMinimumAlpha);
  EXPECT_TRUE(std::isfinite(ggx_distribution(r, Vec3(0.1, 0.2, 0.9).normalized())));
}

TEST(Ggx, ReciprocalAndNotNegative) {
  std::mt19937 random(3);
  const Vec3 f0(0.9, 0.5, 0.04);
  for (int i = 0; i < 1000; ++i) {
    const AnisotropicRoughness r = random_roughness(random, 0.01);
    const Vec3 u = random_up(random);
    const Vec3 v = random_up(random);
    const Vec3 f = ggx_brdf(r, f0, u, v);
    EXPECT_GE(f.minCoeff(), 0);
    EXPECT_LT((f - ggx_brdf(r, f0, v, u)).norm(), 1e-9 * (1 + f.norm()));
  }
  EXPECT_EQ(ggx_brdf({}, f0, Vec3(0, 0.6, -0.8), Vec3::UnitZ()), Vec3::Zero());
}

TEST(Ggx, EqualAlphasAreIsotropic) {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const double alpha = random_in(random, 0.05, 1);
    const Vec3 u = random_up(random);
    const Vec3 v = random_up(random);
    const Mat3 turn = Eigen::AngleAxisd(random_in(random, 0, 6), Vec3::UnitZ()).toRotationMatrix();
    const double f = ggx_brdf({alpha, alpha, 0}, Vec3::Ones(), u, v).x();
    EXPECT_NEAR(ggx_brdf({alpha, alpha, 0}, Vec3::Ones(), turn * u, turn * v).x() / f, 1, 1e-9);
  }
}

TEST(Ggx, TurningTheAxisIsTurningTheDirections) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 u = Vec3(0.3, -0.2, 0.8).normalized();
  const Vec3 v = Vec3(-0.5, 0.1, 0.6).normalized();
  EXPECT_NEAR(ggx_brdf({0.5, 0.1, 0.7}, Vec3::Ones(), turn * u, turn * v).x(),
              ggx_brdf({0.5, 0.1, 0}, Vec3::Ones(), u, v).x(), 1e-12);
}

TEST(Ggx, AlbedoAgreesWithTheIntegralOfTheBrdfAndIsAtMostOne) {
  std::mt19937 random(5);
  const double f0 = 0.3;
  for (int i = 0; i < 12; ++i) {
    const AnisotropicRoughness r = random_roughness(random, 0.2);
    const Vec3 v = random_up(random, 0.15);
    const double reference = test::midpoint_hemisphere(
        [&](const Vec3& u) { return ggx_brdf(r, Vec3::Constant(f0), u, v).x() * u.z(); }, 400);
    const GgxAlbedo albedo = ggx_albedo(r, v);
    EXPECT_NEAR(albedo.scale * f0 + albedo.bias, reference, 2e-3);
    EXPECT_LE(albedo.total(), 1 + 1e-6);
  }
}

TEST(Ggx, CompensationClosesTheFurnace) {
  // A white metal with the lost light given back reflects everything: integral of both lobes = 1.
  for (const AnisotropicRoughness r :
       {AnisotropicRoughness{0.8, 0.8, 0}, AnisotropicRoughness{0.9, 0.3, 0.4}}) {
    const auto albedo = [&](const Vec3& w) { return ggx_albedo(r, w, 16).total(); };
    const double mean = test::midpoint_hemisphere([&](const Vec3& w) { return albedo(w) * w.z() / kPi; }, 24);
    const Vec3 v = Vec3(0.5, 0.3, 0.5).normalized();
    const double multiple = test::midpoint_hemisphere(
        [&](const Vec3& u) {
          return ggx_multiple_scattering(Vec3::Ones(), albedo(u), albedo(v), mean).x() * u.z();
        },
        24);
    EXPECT_NEAR(albedo(v) + multiple, 1, 2e-3);
    EXPECT_LT(albedo(v), 0.97);
  }
}

TEST(Ggx, VisibleNormalSamplesFollowTheirDensity) {
  // Chi-squared over cells of the sphere of lights, in equal-area (z, phi) cells with densities integrated
  // cell by cell.
  constexpr int kZ = 20;
  constexpr int kPhi = 24;
  constexpr int kSamples = 200000;
  std::mt19937 random(6);
  for (const AnisotropicRoughness r :
       {AnisotropicRoughness{0.5, 0.15, 0.3}, AnisotropicRoughness{0.2, 0.9, 1.0},
        AnisotropicRoughness{0.4, 0.4, 0}}) {
    const Vec3 view = random_up(random, 0.2);
    std::vector<double> observed(kZ * kPhi, 0);
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 h = ggx_sample_visible(r, view, {random_in(random, 0, 1), random_in(random, 0, 1)});
      const Vec3 u = 2 * view.dot(h) * h - view;
      const int z = std::clamp(static_cast<int>((u.z() + 1) / 2 * kZ), 0, kZ - 1);
      const int phi =
          std::clamp(static_cast<int>((std::atan2(u.y(), u.x()) / kPi + 1) / 2 * kPhi), 0, kPhi - 1);
      observed[static_cast<std::size_t>(z * kPhi + phi)] += 1;
    }
    double chi_squared = 0;
    double pooled_expected = 0;
    double pooled_observed = 0;
    int cells = 0;
    const auto add = [&](double expected, double seen) {
      chi_squared += (seen - expected) * (seen - expected) / expected;
      ++cells;
    };
    for (int z = 0; z < kZ; ++z) {
      for (int phi = 0; phi < kPhi; ++phi) {
        constexpr int kSub = 24;
        double density = 0;
        for (int a = 0; a < kSub; ++a) {
          for (int b = 0; b < kSub; ++b) {
            const double c = -1 + 2 * (z + (a + 0.5) / kSub) / kZ;
            const double angle = -kPi + 2 * kPi * (phi + (b + 0.5) / kSub) / kPhi;
            const double s = std::sqrt(1 - c * c);
            density += ggx_visible_pdf(r, Vec3(s * std::cos(angle), s * std::sin(angle), c), view);
          }
        }
        const double expected = density / (kSub * kSub) * (4 * kPi / (kZ * kPhi)) * kSamples;
        const double seen = observed[static_cast<std::size_t>(z * kPhi + phi)];
        if (expected < 10) {
          pooled_expected += expected;
          pooled_observed += seen;
        } else {
          add(expected, seen);
        }
      }
    }
    if (pooled_expected > 10) add(pooled_expected, pooled_observed);
    // Wilson and Hilferty: (chi^2 / n)^(1/3) is nearly normal; 4 sigma.
    const double n = cells - 1;
    const double z = (std::cbrt(chi_squared / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
    EXPECT_LT(z, 4) << "alpha " << r.alpha_t << " " << r.alpha_b << ", chi^2 " << chi_squared << " of " << n;
  }
}

}  // namespace
}  // namespace sateen
