// SPDX-License-Identifier: MIT
#include "sateen/geometry/occlusion.h"

#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/core/parallel.h"
#include "support/meshes.h"

namespace sateen::geometry {
namespace {

using namespace test;

void append(Mesh& mesh, const Mesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.uvs.insert(mesh.uvs.end(), other.uvs.begin(), other.uvs.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

TEST(Occlusion, APlaneAndAConvexShapeAreOpen) {
  Mesh plane = make_grid(8, 8, on_plane);
  compute_occlusion(plane, 64);
  for (const float o : plane.occlusion) EXPECT_EQ(o, 1);
  Mesh sphere = make_grid(32, 16, [](double u, double v) { return on_sphere(u, v, 1); });
  compute_occlusion(sphere, 64);
  for (const float o : sphere.occlusion) EXPECT_EQ(o, 1);
}

TEST(Occlusion, InsideAClosedShapeIsNoLight) {
  // u runs the other way round: normals point inwards.
  Mesh sphere = make_grid(32, 16, [](double u, double v) { return on_sphere(1 - u, v, 1); });
  compute_occlusion(sphere, 64);
  for (const float o : sphere.occlusion) EXPECT_EQ(o, 0);
}

TEST(Occlusion, InAHemisphericalCupIsOneHalf) {
  // Inside a sphere every point sees every other under the same density: the missing half is the light that
  // comes in.
  Mesh cup = make_grid(96, 48, [](double u, double v) { return on_sphere(1 - u, 0.5 * v, 1); });
  for (const Vec3f& p : cup.positions) cup.normals.push_back(-p);
  compute_occlusion(cup, 256);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < cup.positions.size(); ++i) {
    if (cup.positions[i].y() > -0.05f) continue;  // the rim's facets
    EXPECT_NEAR(cup.occlusion[i], 0.5, 0.03);
    sum += static_cast<double>(cup.occlusion[i]);
    ++count;
  }
  EXPECT_NEAR(sum / count, 0.5, 0.004);
}

TEST(Occlusion, BesideAWallFollowsItsFormFactor) {
  // A floor point at distance d from a long wall of height h: the wall covers (1 - d / sqrt(d^2 + h^2)) / 2.
  Mesh mesh = make_grid(2, 20, [](double u, double v) { return Vec3(200 * (u - 0.5), 0, 2 - 2 * v); });
  mesh.normals.assign(mesh.positions.size(), Vec3f::UnitY());
  Mesh wall = make_grid(1, 1, [](double u, double v) { return Vec3(200 * (u - 0.5), v, 0); });
  wall.normals.assign(wall.positions.size(), Vec3f::UnitZ());
  append(mesh, wall);
  compute_occlusion(mesh, 2048);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double d = static_cast<double>(mesh.positions[i].z());
    if (mesh.positions[i].x() != 0 || mesh.positions[i].y() != 0 || d < 0.1) continue;
    EXPECT_NEAR(mesh.occlusion[i], 1 - (1 - d / std::hypot(d, 1)) / 2, 0.03) << d;
  }
}

TEST(Occlusion, ReachEndsTheRays) {
  Mesh mesh = make_grid(4, 4, on_plane);
  append(mesh, make_grid(1, 1, [](double u, double v) { return Vec3(6 * u - 2.5, 6 * v - 2.5, 1); }));
  compute_occlusion(mesh, 256, 0.5);
  EXPECT_EQ(mesh.occlusion[12], 1);
  compute_occlusion(mesh, 256, 2);
  // Blocked within 2 when the ceiling at 1 is met at cos >= 1/2: cosine-weighted, 3/4 of the rays.
  EXPECT_NEAR(mesh.occlusion[12], 0.25, 0.02);
}

TEST(Occlusion, BothSidesOfASheetBlock) {
  for (const bool flipped : {false, true}) {
    Mesh mesh = make_grid(4, 4, on_plane);
    append(mesh, make_grid(1, 1, [&](double u, double v) {
             return Vec3(200 * (flipped ? 1 - u : u) - 100, 200 * v - 100, 1);
           }));
    mesh.normals.assign(mesh.positions.size(), Vec3f::UnitZ());
    compute_occlusion(mesh, 64);
    EXPECT_LT(mesh.occlusion[12], 0.02f);
  }
}

TEST(Occlusion, IsTheSameForAnyNumberOfThreadsAndAtSeams) {
  Mesh mesh = make_grid(40, 20, [](double u, double v) { return on_torus(u, v, 1, 0.6); });
  compute_occlusion(mesh, 100);
  for (std::size_t j = 0; j <= 20; ++j) EXPECT_EQ(mesh.occlusion[j * 41], mesh.occlusion[j * 41 + 40]);
  const std::vector<float> parallel = mesh.occlusion;
  limit_threads(1);
  compute_occlusion(mesh, 100);
  limit_threads(0);
  EXPECT_EQ(mesh.occlusion, parallel);
}

TEST(Occlusion, AskingForNoRaysIsAnError) {
  Mesh mesh = make_grid(1, 1, on_plane);
  EXPECT_THROW(compute_occlusion(mesh, 0), Error);
  EXPECT_THROW(compute_occlusion(mesh, 8, -1), Error);
  Mesh none;
  compute_occlusion(none);
  EXPECT_TRUE(none.occlusion.empty());
}

}  // namespace
}  // namespace sateen::geometry
