// SPDX-License-Identifier: MIT
#include "sateen/io/triangulate.h"

#include <random>

#include <gtest/gtest.h>

namespace sateen::io {
namespace {

Vec3 area_vector(const std::vector<Vec3f>& p, const std::array<std::uint32_t, 3>& t) {
  return ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]])).cast<double>() / 2;
}

TEST(Triangulate, StarsKeepTheirAreaAndWinding) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    // A polygon around the origin with random radii is simple, and seldom convex; turned anywhere in space.
    const int n = 3 + trial % 15;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    std::vector<Vec3f> corners;
    double area = 0;
    std::vector<double> radii;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * kPi * i / n;
      radii.push_back(uniform(random));
      const Vec3 flat(radii.back() * std::cos(angle), radii.back() * std::sin(angle), 0);
      corners.push_back((turn * flat + Vec3(3, -2, 5)).cast<float>());
    }
    for (std::size_t i = 0; i < radii.size(); ++i) {
      area += radii[i] * radii[(i + 1) % radii.size()] * std::sin(2 * kPi / n) / 2;
    }
    const auto triangles = triangulate(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    double sum = 0;
    for (const auto& t : triangles) {
      const double signed_area = area_vector(corners, t).dot(turn * Vec3::UnitZ());
      EXPECT_GT(signed_area, -1e-6);
      sum += signed_area;
    }
    EXPECT_NEAR(sum, area, 1e-5);
  }
}

TEST(Triangulate, PolygonsWithoutAreaEndToo) {
  EXPECT_TRUE(triangulate(std::vector<Vec3f>(2, Vec3f::Zero())).empty());
  EXPECT_EQ(triangulate(std::vector<Vec3f>(6, Vec3f::Ones())).size(), 4u);
  std::vector<Vec3f> line;
  for (int i = 0; i < 7; ++i) line.emplace_back(static_cast<float>(i), 0.0f, 0.0f);
  EXPECT_EQ(triangulate(line).size(), 5u);
  // A bow tie.
  EXPECT_EQ(triangulate(std::vector<Vec3f>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
}

}  // namespace
}  // namespace sateen::io
