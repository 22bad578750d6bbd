// SPDX-License-Identifier: MIT
#include "sateen/brdf/quadrature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "brdf/random_directions.h"

namespace sateen::brdf {
namespace {

TEST(Quadrature, KnownIntegralsOfOneVariable) {
  EXPECT_NEAR(integrate([](double x) { return std::sin(x); }, 0, kPi), 2, 1e-12);
  EXPECT_NEAR(integrate([](double x) { return 1 / (1e-4 + x * x); }, -1, 1, 1e-10), 200 * std::atan(100),
              1e-7);
  EXPECT_NEAR(integrate([](double x) { return std::sqrt(x); }, 0, 1), 2.0 / 3, 1e-8);
}

TEST(Quadrature, GaussRulesAreExactForPolynomials) {
  const GaussRule& rule = gauss_rule(5);
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], 9);
  EXPECT_NEAR(sum, 0.1, 1e-14);
}

TEST(Quadrature, HemisphereAboutAnyAxis) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    const Vec3 axis = i == 0 ? Vec3::UnitZ() : i == 1 ? Vec3::UnitX() : test::random_unit(random);
    const std::array<double, 1> cones{test::random_in(random, 0, kPi)};
    EXPECT_NEAR(integrate_hemisphere([](const Vec3&) { return 1.0; }, axis, cones), 2 * kPi, 1e-6);
    EXPECT_NEAR(integrate_hemisphere([](const Vec3& v) { return v.z(); }, axis, cones), kPi, 1e-6);
    double solid_angle = 0;
    double second = 0;
    for (const SphereNode& node : hemisphere_nodes(axis, cones, 16)) {
      EXPECT_GE(node.direction.z(), -1e-12);
      solid_angle += node.weight;
      second += node.weight * node.direction.x() * node.direction.x();
    }
    EXPECT_NEAR(solid_angle, 2 * kPi, 1e-4);
    EXPECT_NEAR(second, 2 * kPi / 3, 1e-4);
  }
}

}  // namespace
}  // namespace sateen::brdf
