// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "sateen/geometry/tangents.h"
#include "support/meshes.h"

namespace sateen::geometry {
namespace {

using namespace test;

TEST(Normals, AreTheSpheresAlsoAcrossTheSeamAndAtThePoles) {
  Mesh mesh = make_grid(64, 32, [](double u, double v) { return on_sphere(u, v, 3); });
  compute_normals(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.normals[i].norm(), 1, 1e-6);
    // A third of an edge beside the poles, where the triangles around a vertex are the least alike; far less
    // elsewhere.
    EXPECT_GT(mesh.normals[i].dot(mesh.positions[i].normalized()), std::cos(0.03));
  }
  for (std::size_t j = 0; j <= 32; ++j) EXPECT_EQ(mesh.normals[j * 65], mesh.normals[j * 65 + 64]);
}

TEST(Normals, AreWeightedByArea) {
  // A corner between a unit square on the floor and a wall three times as high.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 3, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  compute_normals(mesh);
  EXPECT_LT((mesh.normals[0] - Vec3f(3, 1, 0).normalized()).norm(), 1e-6f);
}

TEST(Normals, OfTheFileStay) {
  Mesh mesh = make_grid(1, 1, on_plane);
  mesh.normals.assign(4, Vec3f::UnitX());
  compute_normals(mesh);
  EXPECT_EQ(mesh.normals[2], Vec3f::UnitX());
}

TEST(Normals, OfSheetsBackToBackAndOfUnusedVerticesAreUnit) {
  Mesh mesh = make_grid(2, 2, on_plane);
  const auto front = mesh.triangles;
  for (std::size_t i = 0; i < 9; ++i) mesh.positions.push_back(mesh.positions[i]);
  for (const auto& t : front) mesh.triangles.push_back({t[0] + 9, t[2] + 9, t[1] + 9});
  mesh.uvs.clear();
  mesh.positions.emplace_back(7, 7, 7);
  compute_normals(mesh);
  EXPECT_EQ(mesh.normals[4], Vec3f::UnitZ());
  EXPECT_EQ(mesh.normals[13], Vec3f(-Vec3f::UnitZ()));
  EXPECT_EQ(mesh.normals[18], Vec3f::UnitZ());
}

}  // namespace
}  // namespace sateen::geometry
