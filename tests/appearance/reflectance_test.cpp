// SPDX-License-Identifier: MIT
// What every reflectance promises, asked of every lit example: sampling agrees with its density, and
// integrating lit() by it agrees with the closed term for the surroundings.
#include <gtest/gtest.h>

#include "brdf/random_directions.h"
#include "sateen/appearance/appearance.h"
#include "sateen/scene/registry.h"
#include "support/files.h"

namespace sateen::appearance {
namespace {

struct Example {
  std::string name;
  std::shared_ptr<Appearance> appearance;
  const Reflectance& reflectance() const { return dynamic_cast<const Reflectance&>(*appearance); }
};

const std::vector<Example>& lit_examples() {
  static const std::vector<Example> examples = [] {
    std::vector<Example> result;
    for (const auto& entry : std::filesystem::directory_iterator(test::examples() / "materials")) {
      if (entry.path().extension() != ".json") continue;
      auto appearance = scene::load_appearance(entry.path());
      if (appearance->lit()) result.push_back({entry.path().stem().string(), std::move(appearance)});
    }
    return result;
  }();
  return examples;
}

Surface seen_from(const Vec3& view, double u) {
  Surface surface;
  surface.view = view;
  surface.uv = {u, 0.37};
  return surface;
}

Vec3 uniform3(std::mt19937& random) {
  std::uniform_real_distribution<double> value(0, 1);
  return {value(random), value(random), value(random)};
}

/// What the closed term may be off. Velvet: one factor stands for all lights that cross the fuzz on their way
/// to the reflection. Moss: the slides' ambient product for the simplified fuzz, as printed.
double stated_error(const std::string& example) {
  if (example == "velvet") return 0.1;
  return example == "moss" ? 0.13 : 0.035;
}

TEST(Reflectance, AWhiteFurnaceBySamplesIsTheClosedTermForSurroundings) {
  ASSERT_GE(lit_examples().size(), 7u);
  light::Lighting furnace;
  furnace.surroundings = light::make_surroundings(Image(64, 32, 3, 1));
  constexpr int kSamples = 12000;
  for (const Example& example : lit_examples()) {
    std::mt19937 random(5);
    for (const double cosine : {0.95, 0.6, 0.3}) {
      const Surface surface = seen_from(Vec3(std::sqrt(1 - cosine * cosine), 0, cosine), 0.2);
      const auto point = example.reflectance().at(surface);
      Vec3 sum = Vec3::Zero();
      for (int i = 0; i < kSamples; ++i) {
        const Reflectance::LightSample sample = point->sample(uniform3(random));
        if (sample.pdf > 0) sum += point->lit(sample.light) / sample.pdf;
      }
      const Vec3 sampled = sum / kSamples;
      const Vec3 closed = point->surroundings(furnace.surroundings);
      EXPECT_LT((sampled - closed).norm(), stated_error(example.name) * closed.norm())
          << example.name << " at " << cosine << ": " << sampled.transpose() << " for " << closed.transpose();
    }
  }
}

TEST(Reflectance, SamplesFallAsTheirDensitySays) {
  // The mean of two functions over samples, against their integrals times the density.
  constexpr int kSamples = 20000;
  for (const Example& example : lit_examples()) {
    std::mt19937 random(8);
    const Surface surface = seen_from(Vec3(0.5, 0.2, 0.8).normalized(), 0.6);
    const auto point = example.reflectance().at(surface);
    const auto lobe = [](const Vec3& l) { return std::max(l.z(), 0.0) * (1 + l.x()); };
    double mean = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Reflectance::LightSample sample = point->sample(uniform3(random));
      ASSERT_NEAR(sample.light.norm(), 1, 1e-9);
      EXPECT_NEAR(sample.pdf, point->pdf(sample.light), 1e-9 * std::max(1.0, sample.pdf));
      mean += lobe(sample.light) / kSamples;
    }
    const double integral =
        test::midpoint_hemisphere([&](const Vec3& l) { return lobe(l) * point->pdf(l); }, 250);
    EXPECT_NEAR(mean, integral, 0.03 * integral) << example.name;
  }
}

TEST(Reflectance, LampsAddUpAndWhatIsHiddenIsMissing) {
  light::Lighting lighting;
  lighting.lamps.resize(2);
  lighting.lamps[0].direction = Vec3(0.3, 0.2, 0.9).normalized();
  lighting.lamps[1].direction = Vec3(-0.5, 0.1, 0.8).normalized();
  lighting.lamps[1].colour = {0.5, 2, 1};
  for (const Example& example : lit_examples()) {
    const Surface surface = seen_from(Vec3::UnitZ(), 0.1);
    const auto point = example.reflectance().at(surface);
    const Vec3 second = lighting.lamps[1].colour.cwiseProduct(point->lit(lighting.lamps[1].direction));
    const Vec3 both = example.appearance->radiance(surface, lighting);
    EXPECT_LT((both - second - point->lit(lighting.lamps[0].direction)).norm(), 1e-12) << example.name;
    const Vec3 half = example.appearance->radiance(
        surface, lighting, [](std::size_t lamp, const Surface&) { return lamp == 0 ? 0.0 : 0.5; });
    EXPECT_LT((half - 0.5 * second).norm(), 1e-12) << example.name;
  }
}

// Harmonics of a bright sun ring below zero.
TEST(Reflectance, NothingReflectsLessThanNoLight) {
  light::Lighting dark;
  dark.surroundings = light::even_surroundings({-1, 1, -1});
  for (const Example& example : lit_examples()) {
    const Vec3 seen = example.appearance->radiance(seen_from(Vec3::UnitZ(), 0.1), dark);
    EXPECT_EQ(seen.x(), 0) << example.name;
    EXPECT_GE(seen.y(), 0) << example.name;
  }
}

TEST(Reflectance, OcclusionDarkensTheSurroundingsAndNotLamps) {
  light::Lighting sky;
  sky.surroundings = light::even_surroundings(Vec3::Ones());
  light::Lighting lamp;
  lamp.lamps.resize(1);
  for (const Example& example : lit_examples()) {
    Surface open = seen_from(Vec3::UnitZ(), 0.1);
    Surface hollow = open;
    hollow.occlusion = 0.25;
    const Appearance& a = *example.appearance;
    EXPECT_LT((a.radiance(hollow, sky) - 0.25 * a.radiance(open, sky)).norm(), 1e-12) << example.name;
    EXPECT_EQ(a.radiance(hollow, lamp), a.radiance(open, lamp)) << example.name;
  }
}

}  // namespace
}  // namespace sateen::appearance
