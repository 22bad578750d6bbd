// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "brdf/layered_materials.h"
#include "sateen/brdf/layered/layered.h"
#include "support/rendering.h"
#include "support/shapes.h"

namespace sateen::brdf {
namespace {

using test::brushed;
using test::everything;
using test::fuzzy;
using test::glossy;

// Single precision, half-float environment texels and the driver's filter weights bound what the GPU can do.
constexpr double kTolerance = 4e-3;

void expect_gpu_agrees(const LayeredMaterial& material) {
  test::expect_matches_evaluator(test::torus(), std::make_shared<LayeredAppearance>(material), kTolerance, {},
                                 {}, everything());
}

TEST(LayeredOnGpu, FibreDiffuseEqualsTheEvaluator) {
  LayeredMaterial material;
  material.base.azimuth = 0.6;
  for (const auto base : {DiffuseBase::Model::fibre_diffuse, DiffuseBase::Model::maximum_normal}) {
    material.base.model = base;
    expect_gpu_agrees(material);
  }
}

TEST(LayeredOnGpu, GgxEqualsTheEvaluator) {
  expect_gpu_agrees(glossy());
}

TEST(LayeredOnGpu, FuzzEqualsTheEvaluatorWithEveryPhaseFunction) {
  for (const FuzzPhase phase : {FuzzPhase::sggx, FuzzPhase::sggx_symmetric, FuzzPhase::schlick}) {
    LayeredMaterial material = fuzzy(phase);
    expect_gpu_agrees(material);
    material.fuzz->tilt = 0;
    expect_gpu_agrees(material);
  }
}

TEST(LayeredOnGpu, FuzzOverGlossEqualsTheEvaluator) {
  LayeredMaterial material = fuzzy();
  material.specular = glossy().specular;
  expect_gpu_agrees(material);
  material.fuzz_scattered_down = false;
  expect_gpu_agrees(material);
}

TEST(LayeredOnGpu, TheSlidesFormsEqualTheEvaluator) {
  LayeredMaterial material = fuzzy();
  test::expect_matches_evaluator(
      test::torus(),
      std::make_shared<SlidesAppearance>(SlidesMaterial{.layers = material, .polynomials = true}), kTolerance,
      {}, {}, everything());
}

/// A tangent-space normal map of waves.
std::shared_ptr<const TextureData> waves() {
  auto texture = std::make_shared<TextureData>();
  texture->format = TextureData::Format::rgba8;
  texture->width = texture->height = 64;
  texture->wrap_u = texture->wrap_v = TextureData::Wrap::repeat;
  std::vector<std::byte> texels;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Vec3 n = Vec3(0.5 * std::sin(x * 0.6), 0.5 * std::cos(y * 0.4), 1).normalized();
      for (int c = 0; c < 3; ++c) texels.push_back(static_cast<std::byte>(std::lround(255 * (n[c] + 1) / 2)));
      texels.push_back(std::byte{255});
    }
  }
  texture->levels.push_back(std::move(texels));
  return texture;
}

TEST(LayeredOnGpu, FuzzWithSmoothedNormalsEqualsTheEvaluator) {
  LayeredMaterial material = fuzzy();
  material.specular = glossy().specular;
  for (const double smoothing : {0.0, 0.6, 1.0}) {
    material.fuzz_smoothing = smoothing;
    scene::Scene scene =
        test::scene_of(test::torus(), std::make_shared<LayeredAppearance>(material), {}, everything());
    scene.materials[0].normal_map.texture = waves();
    const render::Picture frame = test::render(scene, {});
    const test::Difference difference = test::against_evaluator(frame, scene, kTolerance);
    EXPECT_GT(difference.pixels, 1000);
    EXPECT_EQ(difference.failing, 0) << "smoothing " << smoothing << ": " << difference.largest;
  }
}

TEST(LayeredOnGpu, FuzzWithAMapOfFibresEqualsTheEvaluator) {
  LayeredMaterial material = fuzzy();
  material.specular = glossy().specular;
  material.fuzz_fibres = brushed();
  for (const FuzzPhase phase : {FuzzPhase::sggx, FuzzPhase::schlick}) {
    material.fuzz->phase = phase;
    test::expect_matches_evaluator(test::plane(), std::make_shared<LayeredAppearance>(material), kTolerance,
                                   {}, {}, everything());
  }
}

TEST(LayeredOnGpu, SimpleFuzzEqualsTheEvaluator) {
  LayeredMaterial material;
  test::expect_matches_evaluator(
      test::torus(),
      std::make_shared<SlidesAppearance>(SlidesMaterial{.layers = material, .simple_fuzziness = 0.6}),
      kTolerance, {}, {}, everything());
}

}  // namespace
}  // namespace sateen::brdf
