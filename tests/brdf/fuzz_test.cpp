// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz.h"

#include <gtest/gtest.h>

#include "brdf/chi_squared.h"
#include "brdf/random_directions.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/quadrature.h"

namespace sateen::brdf {
namespace {

using test::random_in;
using test::random_up;

FuzzParameters random_fuzz(std::mt19937& random, FuzzPhase phase) {
  FuzzParameters fuzz;
  fuzz.phase = phase;
  fuzz.density = random_in(random, 0.01, 0.5);
  fuzz.alpha = random_in(random, 0.15, 1);
  fuzz.k = random_in(random, -0.9, 0.9);
  fuzz.tilt = random_in(random, 0, kPi / 2);
  fuzz.azimuth = random_in(random, 0, 2 * kPi);
  return fuzz;
}

/// The integral of the phase function over all v.
double sphere_total(const FuzzParameters& fuzz, const Vec3& light) {
  return test::midpoint_hemisphere(
      [&](const Vec3& v) { return fuzz_phase(fuzz, light, v) + fuzz_phase(fuzz, light, -v); }, 300);
}

TEST(Fuzz, TheSggxPhaseFunctionIsNormalised) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    const FuzzParameters fuzz = random_fuzz(random, FuzzPhase::sggx);
    EXPECT_NEAR(sphere_total(fuzz, test::random_unit(random)), 1, 3e-3);
  }
}

TEST(Fuzz, SchlickNormalisationIsClosedFormAndNeverCreatesEnergy) {
  for (const double k : {-0.95, -0.5, -0.011, -0.009, 0.0, 0.009, 0.011, 0.1, 0.5, 0.9, 0.99}) {
    const auto lobe = [&](double s) { return (1 - k * k) / (4 * kPi * (1 - k * s) * (1 - k * s)); };
    const double across =
        integrate([&](double a) { return 8 * std::sin(a) * std::sin(a) * lobe(std::sin(a)); }, 0, kPi, 1e-12);
    const double along = integrate(
        [&](double a) { return 8 * kPi * std::cos(a) * std::sin(a) * lobe(std::sin(a)); }, 0, kPi / 2, 1e-12);
    EXPECT_NEAR(fuzz_schlick_normalisation_printed(k) * across, 1, 1e-9) << k;
    EXPECT_NEAR(fuzz_schlick_normalisation_along(k) * along, 1, 1e-9) << k;
    FuzzParameters fuzz;
    fuzz.phase = FuzzPhase::schlick;
    fuzz.k = k;
    if (std::abs(k) > 0.95) continue;
    for (const double angle : {0.0, 0.3, 0.8, 1.2, kPi / 2}) {
      EXPECT_LE(sphere_total(fuzz, Vec3(std::sin(angle), 0, std::cos(angle))), 1 + 2e-3) << k << " " << angle;
    }
  }
  // As printed, with the normalisation for lights across the fibre, a negative k would create energy along
  // it.
  EXPECT_GT(fuzz_schlick_normalisation_printed(-0.8), 1.2 * fuzz_schlick_normalisation(-0.8));
}

TEST(Fuzz, ReciprocityAsStated) {
  std::mt19937 random(2);
  for (const FuzzPhase phase : {FuzzPhase::sggx, FuzzPhase::sggx_symmetric, FuzzPhase::schlick}) {
    for (int i = 0; i < 300; ++i) {
      const FuzzParameters fuzz = random_fuzz(random, phase);
      const Vec3 u = random_up(random);
      const Vec3 v = random_up(random);
      const double forth = fuzz_brdf(fuzz, u, v).x();
      const double back = fuzz_brdf(fuzz, v, u).x();
      EXPECT_GE(forth, 0);
      const double ratio = phase == FuzzPhase::sggx ? fuzz_projected_area(fuzz.alpha, v.dot(fuzz.fibre())) /
                                                          fuzz_projected_area(fuzz.alpha, u.dot(fuzz.fibre()))
                                                    : 1;
      EXPECT_NEAR(forth / back / ratio, 1, 1e-9);
      EXPECT_LE(ratio, 1 / fuzz.alpha + 1e-9);
    }
  }
}

TEST(Fuzz, SymmetricPhaseNeverExceedsTheSggxOne) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    FuzzParameters fuzz = random_fuzz(random, FuzzPhase::sggx);
    const Vec3 u = random_up(random);
    const Vec3 v = random_up(random);
    const double plain = fuzz_brdf(fuzz, u, v).x();
    fuzz.phase = FuzzPhase::sggx_symmetric;
    EXPECT_LE(fuzz_brdf(fuzz, u, v).x(), plain + 1e-12);
  }
}

TEST(Fuzz, AlbedoIsAtMostOneAndVanishesWithTheDensity) {
  std::mt19937 random(4);
  for (const FuzzPhase phase : {FuzzPhase::sggx, FuzzPhase::sggx_symmetric, FuzzPhase::schlick}) {
    for (int i = 0; i < 6; ++i) {
      FuzzParameters fuzz = random_fuzz(random, phase);
      const Vec3 u = random_up(random, 0.02);
      const double albedo = fuzz_albedo(fuzz, u, 1e-5);
      EXPECT_LE(albedo, 1);
      EXPECT_GT(albedo, 0);
      fuzz.density = 1e-9;
      EXPECT_LT(fuzz_albedo(fuzz, u, 1e-5), 1e-5);
      EXPECT_LT((fuzz_attenuation(fuzz, u, u, 0.5) - Vec3::Ones()).norm(), 1e-6);
    }
  }
}

TEST(Fuzz, FibreAlongTheNormalIsIsotropic) {
  std::mt19937 random(5);
  FuzzParameters fuzz;
  fuzz.alpha = 0.3;
  for (int i = 0; i < 100; ++i) {
    const Mat3 turn = Eigen::AngleAxisd(random_in(random, 0, 6), Vec3::UnitZ()).toRotationMatrix();
    const Vec3 u = random_up(random);
    const Vec3 v = random_up(random);
    EXPECT_NEAR(fuzz_brdf(fuzz, turn * u, turn * v).x() / fuzz_brdf(fuzz, u, v).x(), 1, 1e-9);
  }
}

TEST(Fuzz, TiltAndAzimuthPlaceTheFibre) {
  FuzzParameters fuzz;
  fuzz.tilt = kPi / 2;
  EXPECT_LT((fuzz.fibre() - Vec3::UnitX()).norm(), 1e-15);
  fuzz.azimuth = kPi / 2;
  EXPECT_LT((fuzz.fibre() - Vec3::UnitY()).norm(), 1e-15);
  // The line, not the arrow, is the fibre.
  const Vec3 u = Vec3(0.1, 0.5, 0.7).normalized();
  const Vec3 v = Vec3(-0.3, 0.2, 0.4).normalized();
  const double f = fuzz_brdf(fuzz, u, v).x();
  fuzz.azimuth += kPi;
  EXPECT_NEAR(fuzz_brdf(fuzz, u, v).x(), f, 1e-12);
}

TEST(Fuzz, TheExponentIsWhatLightThroughASlabDoes) {
  // Monte Carlo: photons enter a slab of optical thickness d along u, interact at an exponential depth,
  // scatter evenly and leave without a second interaction. alpha = 1 makes the phase function 1 / (4 pi).
  FuzzParameters fuzz;
  fuzz.alpha = 1;
  fuzz.density = 0.4;
  const Vec3 u = Vec3(0.8, 0, 0.35).normalized();
  const Vec3 v = Vec3(-0.2, 0.5, 0.6).normalized();
  std::mt19937 random(6);
  constexpr int kPhotons = 400000;
  double sum = 0;
  for (int i = 0; i < kPhotons; ++i) {
    const double depth = -std::log1p(-random_in(random, 0, 1)) * u.z();
    if (depth > fuzz.density) continue;
    sum += std::exp(-depth / v.z()) / (4 * kPi);
  }
  // Radiant intensity per incident flux towards v, over the cosine: the BRDF.
  EXPECT_NEAR(sum / kPhotons / v.z(), fuzz_brdf(fuzz, u, v).x(), 1e-3 * fuzz_brdf(fuzz, u, v).x() * 5);
  const double printed =
      (1 - std::exp(-fuzz.density * (u.z() + v.z()) / (u.dot(v) * v.z()))) / (u.z() + v.z());
  EXPECT_GT(std::abs(printed / (4 * kPi) / fuzz_brdf(fuzz, u, v).x() - 1), 0.05);
}

TEST(FuzzIntegrals, ScatteredDownAgreesWithPlainSummation) {
  std::mt19937 random(7);
  for (const FuzzPhase phase : {FuzzPhase::sggx, FuzzPhase::schlick}) {
    for (int i = 0; i < 6; ++i) {
      const FuzzParameters fuzz = random_fuzz(random, phase);
      const Vec3 u = random_up(random, 0.05);
      const double up = test::midpoint_hemisphere([&](const Vec3& v) { return fuzz_phase(fuzz, u, v); }, 500);
      EXPECT_NEAR(fuzz_scattered_down(fuzz, u), 1 - up, 2e-3);
    }
  }
  FuzzParameters even;
  even.alpha = 1;
  EXPECT_NEAR(fuzz_scattered_down(even, Vec3(0.6, 0, 0.8)), 0.5, 1e-7);
  EXPECT_NEAR(fuzz_scattered_down_albedo(even), 0.5, 1e-6);
}

TEST(FuzzIntegrals, PassingIsTwiceTheExponentialIntegral) {
  EXPECT_NEAR(fuzz_passing_albedo(0), 1, 1e-12);
  // E_3(1) = 0.10969196719776014 (Abramowitz and Stegun, table 5.4).
  EXPECT_NEAR(exponential_integral_3(1), 0.10969196719776014, 1e-11);
  const double d = 0.3;
  EXPECT_NEAR(
      fuzz_passing_albedo(d),
      test::midpoint_hemisphere([&](const Vec3& u) { return fuzz_passing(d, u) * u.z() / kPi; }, 1000), 1e-5);
}

TEST(FuzzIntegrals, VisibilityAndUniformResponseAgreeWithPlainSummation) {
  std::mt19937 random(8);
  for (int i = 0; i < 5; ++i) {
    const FuzzParameters fuzz = random_fuzz(random, FuzzPhase::sggx);
    const Vec3 v = random_up(random, 0.05);
    const double g = test::midpoint_hemisphere(
        [&](const Vec3& u) {
          return -std::expm1(-fuzz.density * (u.z() + v.z()) / (u.z() * v.z())) * u.z() / (u.z() + v.z());
        },
        600);
    EXPECT_NEAR(fuzz_visibility(fuzz.density, v.z()), g / (2 * kPi), 1e-4);
    const double response =
        test::midpoint_hemisphere([&](const Vec3& u) { return fuzz_brdf(fuzz, u, v).x() * u.z(); }, 600);
    EXPECT_NEAR(fuzz_uniform_response(fuzz, v), response, 2e-3);
  }
}

TEST(Fuzz, SamplesFollowTheSggxPhaseFunction) {
  std::mt19937 random(9);
  for (int i = 0; i < 4; ++i) {
    const FuzzParameters fuzz = random_fuzz(random, FuzzPhase::sggx);
    const Vec3 light = test::random_unit(random);
    const auto sample = [&] {
      return fuzz_sample_view(fuzz, light, {random_in(random, 0, 1), random_in(random, 0, 1)});
    };
    const auto density = [&](const Vec3& v) { return fuzz_phase(fuzz, light, v); };
    EXPECT_LT(test::deviation_from_density(sample, density, 100000), 4)
        << "alpha " << fuzz.alpha << " tilt " << fuzz.tilt;
  }
}

/// The ambient slides' product G (1 - P_s) over the integral it stands for, in uniform light, and the same
/// with the integral of p(u, v) over lights u in place of 1 - P_s(v), which is the integral of p(v, u).
struct ProductError {
  double product = 0;
  double exchanged = 0;
};
ProductError product_error(const FuzzParameters& fuzz, const Vec3& v) {
  const double visibility = fuzz_visibility(fuzz.density, v.z());
  const double response = fuzz_uniform_response(fuzz, v, 1e-6);
  const double up = test::midpoint_hemisphere([&](const Vec3& u) { return fuzz_phase(fuzz, u, v); }, 120);
  return {visibility * (1 - fuzz_scattered_down(fuzz, v, 1e-5)) / response, visibility * up / response};
}

Vec3 polar(double degrees_from_normal, double azimuth) {
  const double theta = radians(degrees_from_normal);
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
}

TEST(FuzzIntegrals, TheSlidesAmbientProductIsTooBrightForGatheredFibres) {
  // 1 - P_s(v) is divided by sigma(v), the response by sigma(u) of the lights. For a view along the fibre
  // sigma(v) = alpha, while the lights it scatters from have sigma near 1: the product is too bright by up to
  // 1 / alpha times what taking G out of the integral costs. Measured: 4.8 along the fibre, 3.4 at 10 to 14
  // degrees beside it, 2 at 30. With the arguments exchanged only the second factor is left.
  FuzzParameters fuzz;
  fuzz.alpha = 0.2;
  fuzz.tilt = radians(45);
  fuzz.density = 0.2;
  double worst = 0;
  double worst_exchanged = 0;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 5; ++j) {
      const ProductError error = product_error(fuzz, polar(3 + 7 * i, kPi * j / 4));
      worst = std::max(worst, error.product);
      worst_exchanged = std::max(worst_exchanged, error.exchanged);
    }
  }
  EXPECT_LT(worst_exchanged, 1.65);
  EXPECT_LT(worst, worst_exchanged / fuzz.alpha);
  EXPECT_NEAR(worst, 4.8, 0.1);  // the grid has the view along the fibre
  fuzz.alpha = 0.95;
  EXPECT_NEAR(product_error(fuzz, polar(45, 0)).product, 1.04, 0.005);
}

}  // namespace
}  // namespace sateen::brdf
