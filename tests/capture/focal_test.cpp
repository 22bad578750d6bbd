// SPDX-License-Identifier: MIT
// A focal length that nobody told, from the ellipse of the sphere's outline.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/judge.h"
#include "sateen/capture/sphere/focal_estimate.h"
#include "sateen/capture/sphere/lens.h"
#include "sateen/core/direction.h"

namespace sateen::capture {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

const Camera& assumed() {
  static const Camera camera = Camera::pinhole(kWidth, kHeight, focal_of_fov(kWidth, radians(kAssumedFov)));
  return camera;
}

/// The outline of a sphere as a camera of that focal length sees it, with a third of a pixel of noise.
std::vector<Vec2> outline(double focal, const Vec2& centre, double radius, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.3);
  const Camera camera = Camera::pinhole(kWidth, kHeight, focal);
  const SphereView sphere = sphere_at(camera, centre, radius);
  std::vector<Vec2> points;
  for (int i = 0; i < 240; ++i)
    points.push_back(sphere.outline_pixel(camera, 2 * kPi * i / 240) + Vec2(noise(random), noise(random)));
  return points;
}

TEST(CaptureFocal, IsFoundWhereTheSphereIsBesideTheMiddle) {
  for (const double focal : {700.0, 1100.0, 2000.0}) {
    const FocalEstimate found = estimate_focal(outline(focal, {1000, 500}, 150), assumed());
    EXPECT_TRUE(found.informed);
    EXPECT_NEAR(found.focal / focal, 1, 0.12) << focal;
    EXPECT_LT(found.low, focal);
    EXPECT_GT(found.high, focal);
  }
}

TEST(CaptureFocal, IntervalsHoldTheTruthAsOftenAsTheySay) {
  int inside = 0;
  constexpr unsigned kTrials = 60;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    // Drawn from the prior, half of them too near the middle to tell.
    std::mt19937 random(seed);
    const double focal =
        assumed().focal.x() * std::exp(std::normal_distribution<double>(0, kFocalPrior)(random));
    const Vec2 centre(640 + (seed % 2 == 0 ? 20 : 300), 400);
    const FocalEstimate found = estimate_focal(outline(focal, centre, 140, seed), assumed());
    inside += found.low <= focal && focal <= found.high ? 1 : 0;
  }
  EXPECT_GE(inside, 54);
}

TEST(CaptureFocal, StaysWithThePriorWhereTheOutlineSaysNothing) {
  for (const double focal : {700.0, 2500.0}) {
    const FocalEstimate found = estimate_focal(outline(focal, {645, 362}, 150), assumed());
    EXPECT_FALSE(found.informed);
    EXPECT_NEAR(found.focal / assumed().focal.x(), 1, 0.02);
    EXPECT_LT(found.low, focal);
    EXPECT_GT(found.high, focal);
  }
  EXPECT_FALSE(estimate_focal({}, assumed()).informed);
}

TEST(CaptureFocal, SomeWrongPointsDoNoHarm) {
  std::vector<Vec2> points = outline(900, {1000, 500}, 150);
  for (std::size_t i = 50; i < 70; ++i) points[i] += Vec2(9, -14);  // a stand
  EXPECT_NEAR(estimate_focal(points, assumed()).focal / 900, 1, 0.12);
}

TEST(CaptureFocal, ACaptureWithoutNotesEstimatesItAndWarns) {
  test::Simulation s = test::small_simulation(24);
  s.focal = 300;
  s.centre = {290, 150};
  s.radius = 60;
  const CaptureResult result = test::capture_of(s, test::informed_options(s, false));
  ASSERT_TRUE(result.lens.estimate);
  EXPECT_TRUE(result.lens.estimate->informed);
  EXPECT_EQ(result.lens.source, FocalSource::outline);
  EXPECT_NEAR(result.lens.camera.focal.x() / s.focal, 1, 0.15);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("estimated from the sphere's outline")));
}

TEST(CaptureFocal, EffectIsThatOfNormalsMetByRays) {
  // The same pixel half-way out, seen by two cameras that see the same outline around their pictures' middle.
  const auto normal = [](double focal) {
    const Camera camera = Camera::pinhole(400, 400, focal);
    Vec3 n;
    EXPECT_TRUE(normal_at_pixel(camera, sphere_at(camera, {200, 200}, 100), {250, 200}, n));
    const Vec3 to_eye = -camera.ray({250, 200});
    return std::acos(n.dot(to_eye));
  };
  EXPECT_NEAR(lens_effect(100, 300, 600).normals, degrees(std::abs(normal(300) - normal(600))), 1e-6);
}

}  // namespace
}  // namespace sateen::capture
