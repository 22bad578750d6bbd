// SPDX-License-Identifier: MIT
#include "sateen/texture/anisotropy.h"

#include <Eigen/Eigenvalues>
#include <random>

#include <gtest/gtest.h>

namespace sateen::texture {
namespace {

class Random {
 public:
  double operator()(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  brdf::AnisotropicRoughness lobe() {
    return {(*this)(brdf::kMinimumAlpha, 1), (*this)(brdf::kMinimumAlpha, 1), (*this)(-kPi, kPi)};
  }
  Vec3 normal() {
    const double z = (*this)(0.01, 1);
    const double phi = (*this)(0, 2 * kPi);
    return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
  }

 private:
  std::mt19937 generator_{7};
};

TEST(Anisotropy, MatrixHasTheSquaredAlphasAsEigenvaluesAlongTheAxis) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const brdf::AnisotropicRoughness lobe = random.lobe();
    const Mat2 s = brdf::roughness_matrix(lobe);
    const Vec2 axis(std::cos(lobe.azimuth), std::sin(lobe.azimuth));
    const Vec2 across(-axis.y(), axis.x());
    EXPECT_NEAR((s * axis - lobe.alpha_t * lobe.alpha_t * axis).norm(), 0, 1e-12);
    EXPECT_NEAR((s * across - lobe.alpha_b * lobe.alpha_b * across).norm(), 0, 1e-12);
    const brdf::AnisotropicRoughness back = brdf::roughness_from_matrix(s);
    EXPECT_NEAR(back.alpha_t, std::max(lobe.alpha_t, lobe.alpha_b), 1e-9);
    EXPECT_NEAR(back.alpha_b, std::min(lobe.alpha_t, lobe.alpha_b), 1e-9);
    EXPECT_NEAR((brdf::roughness_matrix(back) - s).norm(), 0, 1e-9);
    EXPECT_GE(back.azimuth, 0);
    EXPECT_LT(back.azimuth, kPi);
  }
}

TEST(Anisotropy, BothEncodingsReturnTheMatrixAndStayInRange) {
  Random random;
  for (const auto encoding : {AnisotropyEncoding::correlation, AnisotropyEncoding::root}) {
    for (int i = 0; i < 500; ++i) {
      const Mat2 s = brdf::roughness_matrix(random.lobe());
      const Vec3 channels = encode_anisotropy(s, encoding);
      EXPECT_GE(channels.minCoeff(), 0);
      EXPECT_LE(channels.maxCoeff(), 1);
      EXPECT_NEAR((decode_anisotropy(channels, encoding) - s).norm(), 0, 1e-9);
    }
    EXPECT_EQ(anisotropy_encoding_from_name(name_of(encoding)), encoding);
  }
}

TEST(Anisotropy, EncodingsAreThePublishedFormulas) {
  const Mat2 s = brdf::roughness_matrix({0.6, 0.2, 0.7});
  const Vec3 slides = encode_anisotropy(s, AnisotropyEncoding::correlation);
  EXPECT_NEAR(slides[0], std::sqrt(s(0, 0)), 1e-12);
  EXPECT_NEAR(slides[1], 0.5 * s(0, 1) / std::sqrt(s(0, 0) * s(1, 1)) + 0.5, 1e-12);
  EXPECT_NEAR(slides[2], std::sqrt(s(1, 1)), 1e-12);
  const Vec3 root = encode_anisotropy(s, AnisotropyEncoding::root);
  const Mat2 expected = Eigen::SelfAdjointEigenSolver<Mat2>(s).operatorSqrt();
  EXPECT_NEAR(root[0], expected(0, 0), 1e-12);
  EXPECT_NEAR(root[1], expected(0, 1) + 0.5, 1e-12);
  EXPECT_NEAR(root[2], expected(1, 1), 1e-12);
}

TEST(Anisotropy, AnyChannelsDecodeToAGuardedLobe) {
  Random random;
  for (const auto encoding : {AnisotropyEncoding::correlation, AnisotropyEncoding::root}) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 channels(random(-0.1, 1.1), random(-0.1, 1.1), random(-0.1, 1.1));
      const Mat2 s = decode_anisotropy(channels, encoding);
      const brdf::AnisotropicRoughness lobe = brdf::roughness_from_matrix(s);
      EXPECT_GE(lobe.alpha_b, brdf::kMinimumAlpha);
      EXPECT_LE(lobe.alpha_t, 1);
      EXPECT_GE(lobe.alpha_t, lobe.alpha_b);
      EXPECT_NEAR((guarded(s) - brdf::roughness_matrix(lobe)).norm(), 0, 1e-7);
    }
  }
}

TEST(Anisotropy, TheRootOfInterpolatedLobesIsAlwaysPositive) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = encode_anisotropy(brdf::roughness_matrix(random.lobe()), AnisotropyEncoding::root);
    const Vec3 b = encode_anisotropy(brdf::roughness_matrix(random.lobe()), AnisotropyEncoding::root);
    const double t = random();
    const Mat2 s = decode_anisotropy((1 - t) * a + t * b, AnisotropyEncoding::root);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat2>(s).eigenvalues()[0],
              0.999 * brdf::kMinimumAlpha * brdf::kMinimumAlpha);
  }
}

TEST(Sggx, NormalFrameIsTheSmallestRotation) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Vec3 n = random.normal();
    const Mat3 expected = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), n).toRotationMatrix();
    EXPECT_NEAR((normal_frame(n) - expected).norm(), 0, 1e-9);
  }
}

TEST(Sggx, TexelGoesInAndComesOut) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Vec3 n = random.normal();
    brdf::AnisotropicRoughness lobe{random(0.01, 0.7), random(0.01, 0.7), random(0, kPi)};
    const Mat3 s = sroughness_matrix(n, brdf::roughness_matrix(lobe));
    const Vec3 axis = principal_axis(s, n);
    EXPECT_NEAR((axis - n).norm(), 0, 1e-7);
    EXPECT_NEAR((tangent_part(s, n) - brdf::roughness_matrix(lobe)).norm(), 0, 1e-9);
    EXPECT_NEAR((tangent_part(3 * s, n) - brdf::roughness_matrix(lobe)).norm(), 0, 1e-9);
  }
}

TEST(Sggx, PrincipalAxisAgreesWithAnIterativeSolver) {
  Random random;
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    Mat3 a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = random(-1, 1);
    const Mat3 s = a * a.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(s);
    const Vec3 values = solver.eigenvalues();
    Vec3 expected = solver.eigenvectors().col(2);
    if (expected.z() < 0) expected = -expected;
    if ((values[2] - values[1]) / values[2] < 0.4) continue;
    ++compared;
    const Vec3 towards = (expected + 0.3 * Vec3(random(-1, 1), random(-1, 1), random(-1, 1))).normalized();
    EXPECT_NEAR((principal_axis(s, towards) - expected).norm(), 0, 1e-7);
  }
  EXPECT_GT(compared, 500);
}

TEST(Sggx, MeetingEigenvaluesGiveTheMeanNormal) {
  const Vec3 up = Vec3::UnitZ();
  EXPECT_EQ(principal_axis(Mat3::Identity(), up), up);
  EXPECT_EQ(principal_axis(Mat3::Zero(), up), up);
  // Opposing normals 47 degrees to either side, one a little more often: the largest axis lies in the
  // surface, and power iteration finds it.
  const double a = radians(47);
  const Mat2 sharp = brdf::roughness_matrix({0.05, 0.05, 0});
  const Vec3 left(-std::sin(a), 0, std::cos(a));
  const Vec3 right(std::sin(a), 0, std::cos(a));
  const Mat3 s = 0.48 * sroughness_matrix(left, sharp) + 0.52 * sroughness_matrix(right, sharp);
  const Vec3 mean = (0.48 * left + 0.52 * right).normalized();
  EXPECT_LT((principal_axis(s, mean) - mean).norm(), 1e-6);
  EXPECT_GT(degrees(std::acos(principal_axis_by_power_iteration(s, 100).dot(mean))), 60);
}

}  // namespace
}  // namespace sateen::texture
