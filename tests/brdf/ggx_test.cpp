// SPDX-License-Identifier: MIT
#include "sateen/brdf/ggx.h"

#include <gtest/gtest.h>

#include "brdf/chi_squared.h"
#include "brdf/random_directions.h"

namespace sateen::brdf {
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

TEST(Ggx, CompensatedSurfacesAreReciprocalAndReflectAtMostEverything) {
  std::mt19937 random(7);
  for (int i = 0; i < 6; ++i) {
    const AnisotropicRoughness r = random_roughness(random, 0.2);
    const Vec3 f0(random_in(random, 0, 1), 0.04, 1);
    const double mean = ggx_mean_albedo(r);
    const auto albedo = [&](const Vec3& w) { return ggx_albedo(r, w, 16).total(); };
    const Vec3 v = random_up(random, 0.05);
    const Vec3 u = random_up(random, 0.05);
    const double at_v = albedo(v);
    const Vec3 forth = ggx_multiple_scattering(f0, albedo(u), at_v, mean);
    EXPECT_LT((forth - ggx_multiple_scattering(f0, at_v, albedo(u), mean)).norm(), 1e-12);
    EXPECT_GE(forth.minCoeff(), 0);
    const GgxAlbedo single = ggx_albedo(r, v);
    Vec3 sum = f0 * single.scale + Vec3::Constant(single.bias);
    for (int c = 0; c < 3; ++c) {
      sum[c] += test::midpoint_hemisphere(
          [&](const Vec3& l) { return ggx_multiple_scattering(f0, albedo(l), at_v, mean)[c] * l.z(); }, 16);
    }
    EXPECT_LE(sum.maxCoeff(), 1 + 4e-3);
  }
}

TEST(Ggx, VisibleNormalSamplesFollowTheirDensity) {
  std::mt19937 random(6);
  for (const AnisotropicRoughness r :
       {AnisotropicRoughness{0.5, 0.15, 0.3}, AnisotropicRoughness{0.2, 0.9, 1.0},
        AnisotropicRoughness{0.4, 0.4, 0}}) {
    const Vec3 view = random_up(random, 0.2);
    const auto sample = [&]() -> Vec3 {
      const Vec3 h = ggx_sample_visible(r, view, {random_in(random, 0, 1), random_in(random, 0, 1)});
      return 2 * view.dot(h) * h - view;
    };
    EXPECT_LT(test::deviation_from_density(
                  sample, [&](const Vec3& u) { return ggx_visible_pdf(r, u, view); }, 200000),
              4)
        << "alpha " << r.alpha_t << " " << r.alpha_b;
  }
}

}  // namespace
}  // namespace sateen::brdf
