// SPDX-License-Identifier: MIT
#include "sateen/brdf/conventions.h"

#include <gtest/gtest.h>

#include "brdf/random_directions.h"
#include "sateen/brdf/fuzz_integrals.h"

namespace sateen::brdf {
namespace {

using test::random_in;

struct Convention {
  AnisotropicRoughness (*from)(const AnisotropyParameters&);
  AnisotropyParameters (*to)(const AnisotropicRoughness&);
  double largest_ratio;  ///< of the alphas that it can say
};

const Convention kConventions[] = {{from_gltf, to_gltf, 1e9},
                                   {from_materialx, to_materialx, 49},
                                   {from_blender, to_blender, 9.9},
                                   {from_filament, to_filament, 1e9},
                                   {from_substance, to_substance, 1e9}};

TEST(Conventions, EveryRoughnessSurvivesTheRoundTrip) {
  std::mt19937 random(1);
  for (const Convention& convention : kConventions) {
    for (int i = 0; i < 200; ++i) {
      AnisotropicRoughness r{random_in(random, 0.02, 0.95), 0, random_in(random, -3, 6)};
      r.alpha_b = std::clamp(r.alpha_t * std::exp(random_in(random, -2, 2)), 0.02, 0.95);
      if (std::max(r.alpha_t / r.alpha_b, r.alpha_b / r.alpha_t) > convention.largest_ratio) continue;
      const AnisotropyParameters out = convention.to(r);
      EXPECT_GE(out.anisotropy, 0);
      EXPECT_LE(out.anisotropy, 1);
      EXPECT_GE(out.rotation, 0);
      EXPECT_LT(out.rotation, kPi);
      EXPECT_LT((roughness_matrix(convention.from(out)) - roughness_matrix(r)).norm(), 1e-9);
    }
  }
}

TEST(Conventions, NoAnisotropyMeansEqualAlphasEverywhere) {
  for (const Convention& convention : kConventions) {
    const AnisotropicRoughness r = convention.from({0.6, 0, 1});
    EXPECT_NEAR(r.alpha_t, 0.36, 1e-12);
    EXPECT_NEAR(r.alpha_b, 0.36, 1e-12);
  }
}

TEST(Conventions, KnownValues) {
  // glTF: strength 1 is fully rough along the direction. Blender and MaterialX keep the product of the
  // alphas. Filament's strength 1 is a mirror across.
  EXPECT_NEAR(from_gltf({0.4, 1, 0}).alpha_t, 1, 1e-12);
  EXPECT_NEAR(from_gltf({0.4, 0.5, 0}).alpha_t, 0.16 + 0.84 * 0.25, 1e-12);
  EXPECT_NEAR(from_blender({0.5, 1, 0}).alpha_t, 0.25 / std::sqrt(0.1), 1e-12);
  EXPECT_NEAR(from_blender({0.5, 1, 0}).alpha_b, 0.25 * std::sqrt(0.1), 1e-12);
  EXPECT_NEAR(from_materialx({0.5, 0.75, 0}).alpha_t, 0.5, 1e-12);
  EXPECT_NEAR(from_materialx({0.5, 0.75, 0}).alpha_b, 0.125, 1e-12);
  EXPECT_NEAR(from_filament({0.5, 0.6, 0}).alpha_t, 0.4, 1e-12);
  EXPECT_NEAR(from_filament({0.5, -0.6, 0}).alpha_t, 0.1, 1e-12);
  EXPECT_NEAR(from_filament({0.5, 1, 0}).alpha_b, kMinimumAlpha, 1e-12);
  // Substance's shader: roughness along the angle, roughness / sqrt(1 - level) across.
  EXPECT_NEAR(from_substance({0.3, 0.75, 0}).alpha_t, 0.09, 1e-12);
  EXPECT_NEAR(from_substance({0.3, 0.75, 0}).alpha_b, std::pow(0.3 / std::sqrt(0.25), 2), 1e-12);
  EXPECT_NEAR(from_substance({0.9, 1, 0}).alpha_b, 1, 1e-12);
  EXPECT_NEAR(from_substance({0.3, 0.75, 0.4}).azimuth, -0.4, 1e-12) << "clockwise";
}

TEST(Conventions, TheLargerAlphaLiesAlongTheRotation) {
  for (const Convention& convention : kConventions) {
    const AnisotropyParameters out = convention.to({0.1, 0.4, 0});
    // Substance's angle is that of the smaller alpha.
    EXPECT_NEAR(out.rotation, convention.from == from_substance ? 0 : kPi / 2, 1e-12);
    const Mat2 matrix = roughness_matrix(convention.from(out));
    EXPECT_GT(matrix(1, 1), matrix(0, 0));
  }
}

TEST(Conventions, RoughnessAlongAndAcrossSurvivesTheRoundTrip) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const AnisotropicRoughness r{random_in(random, 0.002, 1), random_in(random, 0.002, 1),
                                 random_in(random, -3, 6)};
    const UvRoughness out = to_uv(r);
    EXPECT_GE(out.along, out.across);
    EXPECT_LT((roughness_matrix(from_uv(out)) - roughness_matrix(r)).norm(), 1e-9);
  }
  EXPECT_NEAR(from_uv({0.6, 0.3, 0}).alpha_t, 0.36, 1e-12);
  EXPECT_NEAR(from_uv({0.6, 0.3, 0}).alpha_b, 0.09, 1e-12);
}

TEST(Conventions, ValuesOutOfRangeAreClamped) {
  const auto fits = [](const AnisotropicRoughness& r) {
    return std::min(r.alpha_t, r.alpha_b) >= kMinimumAlpha && std::max(r.alpha_t, r.alpha_b) <= 1;
  };
  for (const double roughness : {0.0, 1.0, -1.0, 2.0}) {
    EXPECT_TRUE(fits(from_uv({roughness, 0.5, 0})));
    for (const Convention& convention : kConventions) {
      for (const double strength : {-2.0, 0.0, 0.5, 1.0, 3.0}) {
        EXPECT_TRUE(fits(convention.from({roughness, strength, 0}))) << roughness << " " << strength;
      }
    }
  }
  for (const Convention& convention : kConventions) {
    for (const double alpha : {0.0, 1.0, 2.0}) {
      const AnisotropyParameters out = convention.to({alpha, alpha, 0});
      EXPECT_TRUE(std::isfinite(out.anisotropy) && std::isfinite(out.roughness));
    }
  }
}

TEST(Conventions, SheenSurvivesTheRoundTrip) {
  for (const double roughness : {0.05, 0.3, 0.7, 1.0}) {
    for (const Vec3& colour : {Vec3(1, 1, 1), Vec3(0.2, 0.5, 0.1)}) {
      const SheenParameters back = to_sheen(from_sheen({colour, roughness}));
      EXPECT_LT((back.colour - colour).norm(), 1e-6);
      EXPECT_NEAR(back.roughness, roughness, 1e-6);
    }
  }
  EXPECT_EQ(from_sheen({}).density, 0);
  // No sheen is brighter than a white one.
  EXPECT_EQ(from_sheen({Vec3(4, 2, 1), 0.5}).density, from_sheen({Vec3(1, 0.5, 0.25), 0.5}).density);
  EXPECT_EQ(to_sheen(from_sheen({})).colour.norm(), 0);
}

TEST(Conventions, SheenKeepsTheSpreadOfNormals) {
  // The mean squared cosine of the matched fibre's flakes, summed over the sphere, is Charlie's 1 / (3 + 1 /
  // r^2).
  const FuzzParameters fuzz = from_sheen({Vec3::Ones(), 0.5});
  double total = 0;
  const double second = test::midpoint_hemisphere(
      [&](const Vec3& h) {
        const double d = fuzz_fibre_distribution(fuzz.alpha, h.z());
        total += d;
        return d * h.z() * h.z();
      },
      400);
  EXPECT_NEAR(second / (total * kPi / 160000), 1.0 / 7, 1e-4);
}

}  // namespace
}  // namespace sateen::brdf
