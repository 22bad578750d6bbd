// SPDX-License-Identifier: MIT
#include "sateen/geometry/curvature.h"

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace sateen::geometry {
namespace {

using namespace test;

TEST(Curvature, OfASphereIsOneOverItsRadiusAndItsInsideNegative) {
  for (const double radius : {0.01, 1.0, 50.0}) {
    for (const bool inside : {false, true}) {
      Mesh mesh =
          make_grid(64, 32, [&](double u, double v) { return on_sphere(inside ? 1 - u : u, v, radius); });
      for (const Vec3f& p : mesh.positions) mesh.normals.push_back((inside ? -1.0f : 1.0f) * p.normalized());
      const PrincipalCurvatures principal = compute_curvature(mesh);
      const double expected = (inside ? -1 : 1) / radius;
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(mesh.curvature[i], expected, 0.02 / radius);
        EXPECT_NEAR(principal.k1[i], expected, 0.05 / radius);
        EXPECT_NEAR(principal.k2[i], expected, 0.05 / radius);
      }
    }
  }
}

TEST(Curvature, OfACylinderBendsAroundItsAxisOnly) {
  for (const bool inside : {false, true}) {
    const float sign = inside ? -1 : 1;
    Mesh mesh = make_grid(96, 16, [&](double u, double v) { return on_cylinder(inside ? 1 - u : u, v, 2); });
    for (const Vec3f& p : mesh.positions) mesh.normals.push_back(sign * Vec3f(p.x(), 0, p.z()).normalized());
    const PrincipalCurvatures principal = compute_curvature(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_NEAR(mesh.curvature[i], sign / (2 * 2.0), 0.003);
      EXPECT_NEAR(principal.k1[i], sign * 0.5, 0.005);
      EXPECT_NEAR(principal.k2[i], 0, 0.005);
      EXPECT_NEAR(principal.direction1[i].y(), 0, 0.01);
      EXPECT_NEAR(std::abs(principal.direction2[i].y()), 1, 0.001);
    }
  }
}

TEST(Curvature, OfATorusHasBothSigns) {
  const double radius = 2;
  const double tube = 0.8;
  Mesh mesh = make_grid(160, 80, [&](double u, double v) { return on_torus(u, v, radius, tube); });
  const PrincipalCurvatures principal = compute_curvature(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double cosine = std::cos(2 * kPi * static_cast<double>(mesh.uvs[i].y()));
    const double around = cosine / (radius + tube * cosine);
    EXPECT_NEAR(principal.k1[i], 1 / tube, 0.02);
    EXPECT_NEAR(principal.k2[i], around, 0.02);
    EXPECT_NEAR(mesh.curvature[i], (1 / tube + around) / 2, 0.02);
  }
}

TEST(Curvature, OfASaddleCancels) {
  // z = a x y: at the centre the principal curvatures are -a and +a, along the diagonals.
  Mesh mesh =
      make_grid(20, 20, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 3 * (u - 0.5) * (v - 0.5)); });
  const PrincipalCurvatures principal = compute_curvature(mesh);
  const std::size_t centre = 10 * 21 + 10;
  EXPECT_NEAR(mesh.curvature[centre], 0, 0.01);
  EXPECT_NEAR(std::abs(principal.k1[centre]), 3, 0.1);
  EXPECT_NEAR(std::abs(principal.k2[centre]), 3, 0.1);
  EXPECT_NEAR(std::abs(principal.direction1[centre].x()), std::sqrt(0.5), 0.01);
  // Along x = y the surface bends upwards, away from nothing outside: concave.
  const float along = principal.direction1[centre].x() * principal.direction1[centre].y();
  EXPECT_LT(along * principal.k1[centre], 0);
}

TEST(Curvature, IsZeroOnAPlaneAndForUnusedVertices) {
  Mesh mesh = make_grid(3, 3, on_plane);
  mesh.positions.emplace_back(5, 5, 5);
  compute_curvature(mesh);
  for (const float k : mesh.curvature) EXPECT_NEAR(k, 0, 1e-6);
}

}  // namespace
}  // namespace sateen::geometry
