// SPDX-License-Identifier: MIT
#include "sateen/matcap/filter_estimate.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/matcap/separation.h"
#include "sateen/matcap/signature_plot.h"
#include "sateen/matcap/warp.h"
#include "support/matcaps.h"

namespace sateen::matcap {
namespace {

constexpr int kSizes[] = {128, 256, 512};

/// A primitive of known variance (Figure 5): a Gaussian of the distance to a point.
struct Spot {
  double theta;
  double azimuth;
  double variance;
};

Image spots(int size, const std::vector<Spot>& list) {
  return test::sphere_picture(size, [&](const Vec3& n) -> Vec3 {
    double sum = 0;
    for (const Spot& s : list) {
      const double angle = test::angle_between(n, test::direction_at(s.theta, s.azimuth));
      sum += std::exp(-angle * angle / (2 * s.variance));
    }
    return Vec3::Constant(sum);
  });
}

Region region_at(int size, double theta, double azimuth) {
  const Vec2 p = disc_pixel(inscribed_disc(size, size), test::direction_at(theta, azimuth).head<2>());
  const int half = std::max(1, size / 128);
  return {static_cast<int>(p.x()) - half, static_cast<int>(p.y()) - half, 2 * half + 1, 2 * half + 1};
}

double estimated(const Image& image, const Spot& s) {
  return estimate_filter(image, inscribed_disc(image.width, image.width),
                         {region_at(image.width, s.theta, s.azimuth)}, -1, "test")
      .variance;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

TEST(Moments, UntruncatedInvertsTheTruncatedNormal) {
  for (const Moments& normal : {Moments{0, 0.01}, {0.05, 0.04}, {-0.2, 0.09}, {0.1, 0.3}}) {
    const auto back = untruncated(truncated_moments(normal, -0.5, 0.4), -0.5, 0.4);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->mean, normal.mean, 1e-3);
    EXPECT_NEAR(back->variance / normal.variance, 1, 5e-3);
  }
  // By quadrature: the variance of exp(-x^2 / 0.02) over [-0.2, 0.1].
  double sum = 0;
  double sum1 = 0;
  double sum2 = 0;
  for (int i = 0; i < 30000; ++i) {
    const double x = -0.2 + 1e-5 * (i + 0.5);
    const double w = std::exp(-x * x / 0.02);
    sum += w;
    sum1 += w * x;
    sum2 += w * x * x;
  }
  const Moments cut = truncated_moments({0, 0.01}, -0.2, 0.1);
  EXPECT_NEAR(cut.mean, sum1 / sum, 1e-7);
  EXPECT_NEAR(cut.variance, sum2 / sum - sum1 * sum1 / (sum * sum), 1e-7);
}

// Equation (6) as printed has its denominator's sign reversed: every variance would be negative.
TEST(Signature, OfAGaussianIsItsVarianceForEveryWindow) {
  const Image image = with_channels(spots(256, {{0.5, 0.7, 0.01}}), 1);
  const MeridianProfile profile = meridian_profile(image, inscribed_disc(256, 256), 0.7);
  for (const double eps : {0.12, 0.3, 0.6, 1.2}) {
    const auto variance = windowed_variance(profile, 0.5, eps);
    ASSERT_TRUE(variance);
    EXPECT_NEAR(*variance, 0.01, 5e-5) << eps;
  }
  // Off the peak it is the same Gaussian under the same window.
  EXPECT_NEAR(*windowed_variance(profile, 0.55, 0.3), 0.01, 5e-5);
}

TEST(Signature, WithoutEnergyOrShapeIsDegenerate) {
  const MeridianProfile black{0.01, std::vector<double>(315, 0)};
  EXPECT_FALSE(signature(black, 0.2, 0.05).chosen);
  const MeridianProfile flat{0.01, std::vector<double>(315, 0.5)};
  EXPECT_FALSE(windowed_variance(flat, 0, 0.5));
}

TEST(FilterEstimate, IsolatedPrimitivesWithinTwoPercentAtThreeResolutions) {
  std::vector<double> errors;
  for (const int size : kSizes) {
    for (const Spot& s :
         {Spot{0.2, 0.3, 0.004}, {0.8, 2.5, 0.01}, {0.5, 4, 0.03}, {0.3, 5.5, 0.06}, {1.0, 1, 0.02}}) {
      const double error = std::abs(estimated(spots(size, {s}), s) / s.variance - 1);
      EXPECT_LT(error, 0.02) << size << " " << s.variance;
      errors.push_back(error);
    }
  }
  EXPECT_LT(median(errors), 0.01);
}

TEST(FilterEstimate, EdgesAreMeasuredByTheDerivative) {
  for (const int size : kSizes) {
    for (const double variance : {0.002, 0.006}) {
      const Vec3 centre = test::direction_at(1.4, 0.2);
      const Image image = test::sphere_picture(size, [&](const Vec3& n) -> Vec3 {
        return Vec3::Constant(0.5 *
                              std::erfc((test::angle_between(n, centre) - 0.9) / std::sqrt(2 * variance)));
      });
      const FilterEstimate estimate =
          estimate_filter(image, inscribed_disc(size, size), {region_at(size, 0.5, 0.2)}, -1, "test");
      EXPECT_EQ(estimate.feature, Feature::edge);
      EXPECT_NEAR(estimate.variance / variance, 1, 0.02) << size;
    }
  }
}

TEST(FilterEstimate, CrowdedPrimitivesWithinFivePercent) {
  const std::vector<Spot> crowd{{0.35, 0, 0.004}, {0.95, 0, 0.01}, {0.5, kPi, 0.015}};
  std::vector<double> errors;
  for (const int size : kSizes) {
    const Image image = spots(size, crowd);
    for (const Spot& s : crowd) {
      const double error = std::abs(estimated(image, s) / s.variance - 1);
      EXPECT_LT(error, 0.05) << size << " " << s.variance;
      errors.push_back(error);
    }
  }
  EXPECT_LT(median(errors), 0.01);
}

// Figure 5: nine regions of one picture, spots and edges, alone on their meridian and crowded.
TEST(FilterEstimate, NineRegionsOfOnePicture) {
  const std::vector<Spot> alone{{0.9, 0.4, 0.004}, {1.0, 1.3, 0.008}, {0.8, 2.2, 0.002}};
  const std::vector<Spot> crowded{
      {0.3, 3.1, 0.003}, {0.75, 3.1, 0.005}, {1.2, 3.1, 0.002}, {0.35, 5.2, 0.003}};
  const std::vector<Spot> caps{{1.0, 4.2, 0.002}, {1.1, 5.2, 0.002}};  // the second ends near the last spot
  constexpr double kCap = 0.3;                                         // radius in radians
  std::vector<double> errors;
  for (const int size : kSizes) {
    Image image = spots(size, alone);
    const Image more = spots(size, crowded);
    const Image discs = test::sphere_picture(size, [&](const Vec3& n) -> Vec3 {
      double sum = 0;
      for (const Spot& cap : caps) {
        const double angle = test::angle_between(n, test::direction_at(cap.theta, cap.azimuth));
        sum += 0.5 * std::erfc((angle - kCap) / std::sqrt(2 * cap.variance));
      }
      return Vec3::Constant(sum);
    });
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] += more.data[i] + discs.data[i];
    const auto check = [&](const Spot& s, double theta, Feature feature, double bound) {
      const FilterEstimate estimate =
          estimate_filter(image, inscribed_disc(size, size), {region_at(size, theta, s.azimuth)}, -1, "nine");
      const double error = std::abs(estimate.variance / s.variance - 1);
      EXPECT_LT(error, bound) << size << " " << theta << " " << s.azimuth;
      EXPECT_EQ(estimate.feature, feature) << size << " " << theta << " " << s.azimuth;
      errors.push_back(error);
    };
    for (const Spot& s : alone) check(s, s.theta, Feature::line, 0.02);
    for (const Spot& s : crowded) check(s, s.theta, Feature::line, 0.05);
    check(caps[0], caps[0].theta - kCap, Feature::edge, 0.02);
    check(caps[1], caps[1].theta - kCap, Feature::edge, 0.05);
  }
  EXPECT_EQ(errors.size(), 27U);
  EXPECT_LT(median(errors), 0.01);
}

TEST(FilterEstimate, FindsTheSharpestFeatureItself) {
  for (const int size : kSizes) {
    const Image image = spots(size, {{0.35, 0.5, 0.006}, {0.9, 2.5, 0.03}, {0.7, 4.4, 0.02}});
    const FilterEstimate estimate = estimate_filter(image, inscribed_disc(size, size), -1);
    ASSERT_TRUE(estimate.measured);
    EXPECT_NEAR(estimate.variance / 0.006, 1, 0.03) << size;
    const Vec2 p = disc_point(inscribed_disc(size, size), estimate.regions[0].x, estimate.regions[0].y);
    EXPECT_LT((p - test::direction_at(0.35, 0.5).head<2>()).norm(), 0.1);
  }
}

// Grain is sharp everywhere but nowhere confirmed by its neighbours.
TEST(FilterEstimate, GrainDoesNotPassForAFeature) {
  const Image smooth = spots(256, {{0.5, 1, 0.02}});
  Image grainy = smooth;
  unsigned state = 1;
  for (float& v : grainy.data) {
    state = state * 1664525U + 1013904223U;
    v = std::max(0.0F, v + 0.03F * (static_cast<float>(state >> 8) / 16777216.0F - 0.5F));
  }
  const FilterEstimate estimate = estimate_filter(grainy, inscribed_disc(256, 256), -1);
  ASSERT_TRUE(estimate.measured);
  EXPECT_NEAR(std::sqrt(estimate.variance / 0.02), 1, 0.25);
}

/// The regions of tests/data/matcap_regions.txt for one MatCap's high part.
std::vector<Region> careful_regions(const std::string& matcap) {
  std::istringstream lines(io::read_text(test::source_dir() / "tests" / "data" / "matcap_regions.txt"));
  std::vector<Region> regions;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::string part;
    words >> name >> part;
    if (name != matcap || part != "high") continue;
    Region r;
    char comma = 0;
    while (words >> r.x >> comma >> r.y >> comma >> r.width >> comma >> r.height) regions.push_back(r);
  }
  return regions;
}

// Regions drawn by hand around the sharpest features of the shipped MatCaps, on their high parts.
// tools/compare-matcap-regions compares more MatCaps. Lead has a smaller region here: around its whole
// highlight, as in that file, a few pixels of a hot spot are measured, 2.1 against 4.5 degrees found.
TEST(FilterEstimate, AgreesWithACarefulUser) {
  for (const char* name : test::kMatcaps) {
    const std::vector<Region> regions =
        name == std::string("lead") ? std::vector<Region>{{167, 58, 10, 6}} : careful_regions(name);
    ASSERT_FALSE(regions.empty()) << name;
    const Image picture = to_add_up_space(test::example_matcap(name, 256), AddUpSpace::display);
    const Disc disc = inscribed_disc(256, 256);
    const Image high = separate(picture, disc, Outliers::ignore, name).high;
    const FilterEstimate user = estimate_filter(high, disc, regions, -1, name);
    const FilterEstimate automatic = estimate_filter(high, disc, -1);
    ASSERT_TRUE(user.measured && automatic.measured) << name;
    // The standard deviations in pixels, where features are as sharp as pixels allow.
    const double by_user = std::sqrt(user.variance) * disc.radius;
    const double found = std::sqrt(automatic.variance) * disc.radius;
    EXPECT_TRUE(std::abs(found / by_user - 1) < 0.25 || std::abs(found - by_user) < 1)
        << name << ": " << found << " pixels, by the user's regions " << by_user;
  }
}

// Separation leaves an envelope of cosine lobes: nothing in it is sharper than Lambertian shading, whose
// signature settles near where the slope is 0.
TEST(FilterEstimate, LowPartsAreTakenForLambertian) {
  for (const double theta : {0.0, 0.5, 1.0}) {
    const Image image = with_channels(
        test::sphere_picture(256,
                             [&](const Vec3& n) -> Vec3 {
                               return Vec3::Constant(std::max(0.0, n.dot(test::direction_at(theta, 0.7))));
                             }),
        1);
    const Disc disc = inscribed_disc(256, 256);
    const Signature s = signature(meridian_profile(image, disc, 0.7), theta, 0.05);
    ASSERT_TRUE(s.chosen);
    EXPECT_GT(s.variance[*s.chosen], 0.7) << theta;  // above the lobe's own 0.467
  }
  for (const char* name : test::kMatcaps) {
    const Disc disc = inscribed_disc(128, 128);
    const Image picture = to_add_up_space(test::example_matcap(name, 128), AddUpSpace::display);
    const FilterEstimate low =
        estimate_filter(separate(picture, disc, Outliers::ignore, name).low, disc, kLambertian);
    EXPECT_FALSE(low.measured) << name << ": " << low.variance;
    EXPECT_EQ(slope_of_variance(low.variance), 0) << name;
  }
}

TEST(FilterEstimate, FallsBackWhereNothingIsSharp) {
  const Image flat = test::sphere_picture(128, [](const Vec3&) -> Vec3 { return Vec3::Constant(0.5); });
  const FilterEstimate estimate = estimate_filter(flat, inscribed_disc(128, 128), 0.123);
  EXPECT_FALSE(estimate.measured);
  EXPECT_EQ(estimate.variance, 0.123);
  EXPECT_THROW(estimate_filter(flat, inscribed_disc(128, 128), {{0, 0, 2, 2}}, 0.1, "test"), Error);
}

TEST(SignaturePlot, DrawsACurveAndItsChoice) {
  const Spot s{0.5, 0.7, 0.01};
  const FilterEstimate estimate =
      estimate_filter(spots(128, {s}), inscribed_disc(128, 128), {region_at(128, 0.5, 0.7)}, -1, "t");
  const std::vector<LabelledEstimate> curves{{"high", estimate}};
  const std::string svg = signature_svg(curves);
  EXPECT_THAT(svg, testing::HasSubstr("<circle"));
  EXPECT_THAT(svg, testing::HasSubstr("high: variance 0.01"));
}

}  // namespace
}  // namespace sateen::matcap
