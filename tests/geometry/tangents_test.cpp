// SPDX-License-Identifier: MIT
#include "sateen/geometry/tangents.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/geometry/tangent_fill.h"
#include "support/meshes.h"

namespace sateen::geometry {
namespace {

using namespace test;

Vec3f tangent(const Mesh& mesh, std::size_t i) {
  return mesh.tangents[i].head<3>();
}

void expect_frames(const Mesh& mesh) {
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_TRUE(mesh.tangents[i].allFinite()) << i;
    ASSERT_NEAR(tangent(mesh, i).norm(), 1, 1e-6) << i;
    ASSERT_NEAR(tangent(mesh, i).dot(mesh.normals[i]), 0, 1e-6) << i;
    ASSERT_EQ(std::abs(mesh.tangents[i].w()), 1) << i;
  }
}

// Largest angle to the tangents `truth` gives for a vertex.
template <class Truth>
double worst_angle(const Mesh& mesh, const Truth& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
    const Vec3 expected = truth(mesh.positions[i].cast<double>(), mesh.uvs[i].cast<double>());
    if (expected.isZero(0)) continue;
    const double cosine = tangent(mesh, i).cast<double>().dot(expected.normalized());
    worst = std::max(worst, std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  return worst;
}

struct Shape {
  std::string name;
  std::function<Mesh()> make;
};

std::vector<Shape> difficult_shapes() {
  std::vector<Shape> shapes;
  shapes.push_back(
      {"poles", [] { return make_grid(24, 12, [](double u, double v) { return on_sphere(u, v, 1); }); }});
  shapes.push_back(
      {"closed", [] { return make_grid(24, 12, [](double u, double v) { return on_torus(u, v, 2, 1); }); }});
  shapes.push_back({"slivers", [] {
                      Mesh mesh = make_grid(9, 9, on_plane);
                      for (std::size_t i = 0; i < 10; ++i)
                        mesh.positions[30 + i].y() = mesh.positions[20 + i].y() + 1e-8f;
                      return mesh;
                    }});
  shapes.push_back({"no UV area", [] {
                      Mesh mesh = make_grid(9, 9, on_plane);
                      mesh.uvs.assign(mesh.uvs.size(), Vec2f(0.5f, 0.5f));
                      return mesh;
                    }});
  shapes.push_back({"UVs on a line", [] {
                      Mesh mesh = make_grid(9, 9, on_plane);
                      for (Vec2f& uv : mesh.uvs) uv.y() = uv.x();
                      return mesh;
                    }});
  shapes.push_back({"mirrored UVs", [] {
                      Mesh mesh = make_grid(10, 4, on_plane);
                      for (Vec2f& uv : mesh.uvs) uv.x() = std::abs(uv.x() - 0.5f);
                      return mesh;
                    }});
  shapes.push_back({"huge and tiny numbers", [] {
                      Mesh mesh =
                          make_grid(6, 6, [](double u, double v) { return Vec3(1e15 * u, 1e15 * v, 0); });
                      for (Vec2f& uv : mesh.uvs) uv *= 1e-12f;
                      return mesh;
                    }});
  shapes.push_back(
      {"tiny mesh",
       [] { return make_grid(6, 6, [](double u, double v) { return Vec3(1e-15 * u, 1e-15 * v, 0); }); }});
  shapes.push_back({"unused vertex", [] {
                      Mesh mesh = make_grid(2, 2, on_plane);
                      mesh.positions.emplace_back(3, 3, 3);
                      mesh.uvs.emplace_back(0, 0);
                      return mesh;
                    }});
  shapes.push_back({"random soup", [] {
                      std::mt19937 random(5);
                      std::uniform_real_distribution<float> uniform(-1, 1);
                      Mesh mesh;
                      for (std::uint32_t i = 0; i < 300; ++i) {
                        mesh.positions.emplace_back(uniform(random), uniform(random), uniform(random));
                        mesh.uvs.emplace_back(uniform(random), uniform(random));
                        mesh.triangles.push_back({i, (i * 7 + 3) % 300, (i * 31 + 11) % 300});
                      }
                      return mesh;
                    }});
  return shapes;
}

TEST(Tangents, AreUnitOrthogonalAndFiniteOnDifficultShapes) {
  for (const Shape& shape : difficult_shapes()) {
    SCOPED_TRACE(shape.name);
    Mesh mesh = shape.make();
    compute_tangents(mesh);
    expect_frames(mesh);
    mesh = shape.make();
    set_tangents_around(mesh, Vec3f::UnitY(), Vec3f::Zero());
    expect_frames(mesh);
    mesh = shape.make();
    set_tangents_along(mesh, Vec3f(1, 2, 3));
    expect_frames(mesh);
    rotate_tangents(mesh, 1);
    expect_frames(mesh);
  }
}

TEST(Tangents, RunAlongUOnAPlaneAtAnyScaleAndRotationOfTheUvs) {
  for (const double angle : {0.0, 0.3, 2.0, 4.0}) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
      Mesh mesh = make_grid(5, 4, on_plane);
      for (Vec2f& uv : mesh.uvs) uv = (scale * (Eigen::Rotation2Dd(angle) * uv.cast<double>())).cast<float>();
      compute_tangents(mesh);
      const Vec3 expected(std::cos(angle), -std::sin(angle), 0);
      EXPECT_LT(worst_angle(mesh, [&](const Vec3&, const Vec2&) { return expected; }), 1e-3);
      for (const Vec4f& t : mesh.tangents) EXPECT_EQ(t.w(), 1);
    }
  }
}

TEST(Tangents, FollowTheGradientOfUNotTheEdgeAlongU) {
  // Sheared UVs: u = x + y grows fastest along (1, 1), while lines of constant v run along x.
  Mesh mesh = make_grid(4, 4, on_plane);
  for (Vec2f& uv : mesh.uvs) uv.x() += uv.y();
  compute_tangents(mesh);
  EXPECT_LT(worst_angle(mesh, [&](const Vec3&, const Vec2&) { return Vec3(1, 1, 0); }), 1e-3);
}

TEST(Tangents, ConvergeToTheAnalyticOnesOnCurvedSurfaces) {
  const auto east = [](const Vec3& p, const Vec2&) { return Vec3(p.z(), 0, -p.x()); };
  Mesh cylinder = make_grid(48, 6, [](double u, double v) { return on_cylinder(u, v, 2); });
  compute_tangents(cylinder);
  // Between the ends, where a vertex sees triangles on both sides; at the ends the error is at most half an
  // edge's angle.
  const auto between = [&](const Vec3& p, const Vec2& uv) {
    return uv.minCoeff() > 0 && uv.maxCoeff() < 1 ? east(p, uv) : Vec3(Vec3::Zero());
  };
  EXPECT_LT(worst_angle(cylinder, between), 5e-4);
  EXPECT_LT(worst_angle(cylinder, east), kPi / 48);
  double before = 0;
  for (const int n : {24, 48, 96}) {
    Mesh torus = make_grid(2 * n, n, [](double u, double v) { return on_torus(u, v, 2, 0.7); });
    compute_tangents(torus);
    const double error = worst_angle(torus, east);
    if (before > 0) {
      EXPECT_LT(error, 0.6 * before);
    }
    before = error;
  }
  EXPECT_LT(before, 0.02);
  Mesh sphere = make_grid(96, 48, [](double u, double v) { return on_sphere(u, v, 1); });
  compute_tangents(sphere);
  const auto inside = [&](const Vec3& p, const Vec2& uv) {
    return uv.y() > 0.1 && uv.y() < 0.9 ? east(p, uv) : Vec3(Vec3::Zero());
  };
  EXPECT_LT(worst_angle(sphere, inside), 0.04);
}

TEST(Tangents, HandednessTellsMirroredUvs) {
  Mesh mesh = make_grid(3, 3, on_plane);
  for (Vec2f& uv : mesh.uvs) uv.x() = -uv.x();
  compute_tangents(mesh);
  for (const Vec4f& t : mesh.tangents) EXPECT_LT((t - Vec4f(-1, 0, 0, -1)).norm(), 1e-5f);
}

TEST(Tangents, MirroredHalvesKeepTheirOwnWhereTheyMeet) {
  Mesh mesh = make_grid(10, 4, on_plane);
  for (const Vec3f& p : mesh.positions) mesh.occlusion.push_back(p.y());
  for (Vec2f& uv : mesh.uvs) uv.x() = std::abs(uv.x() - 0.5f);
  compute_tangents(mesh);
  EXPECT_EQ(mesh.positions.size(), 55u + 5u);
  EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
  ASSERT_EQ(mesh.occlusion.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_LT((mesh.uvs[i] - Vec2f(std::abs(mesh.positions[i].x() - 0.5f), mesh.positions[i].y())).norm(),
              1e-6f);
    EXPECT_EQ(mesh.occlusion[i], mesh.positions[i].y());
  }
  for (const auto& triangle : mesh.triangles) {
    const float side =
        (mesh.positions[triangle[0]] + mesh.positions[triangle[1]] + mesh.positions[triangle[2]]).x() / 3;
    const float sign = side > 0.5f ? 1.0f : -1.0f;
    for (const std::uint32_t v : triangle) {
      EXPECT_LT((mesh.tangents[v] - Vec4f(sign, 0, 0, sign)).norm(), 1e-4f);
    }
  }
}

TEST(Tangents, SeamsStaySplit) {
  Mesh mesh = make_grid(2, 1, on_plane);
  // The right half becomes an island of its own, turned by a quarter.
  Mesh right = mesh;
  mesh.triangles.resize(2);
  right.triangles.erase(right.triangles.begin(), right.triangles.begin() + 2);
  std::swap(mesh.triangles[1], mesh.triangles[0]);
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < right.positions.size(); ++i) {
    mesh.positions.push_back(right.positions[i]);
    mesh.uvs.emplace_back(right.uvs[i].y(), -right.uvs[i].x());
  }
  for (const auto& t : right.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  compute_tangents(mesh);
  EXPECT_LT((tangent(mesh, 1) - Vec3f::UnitX()).norm(), 1e-5f);
  EXPECT_LT((tangent(mesh, 1 + offset) - Vec3f::UnitY()).norm(), 1e-5f);
}

TEST(Tangents, VerticesWithoutInformationTakeTheirNeighbours) {
  // The UVs of the right half collapse to a line: its tangents come from the left, vertex by vertex.
  Mesh mesh = make_grid(20, 3, on_plane);
  for (Vec2f& uv : mesh.uvs) {
    if (uv.x() > 0.5f) uv = {0.5f, 0.5f};
  }
  compute_tangents(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].x() < 0.45f || mesh.positions[i].x() > 0.6f) {
      EXPECT_LT((tangent(mesh, i) - Vec3f::UnitX()).norm(), 0.5f) << i;
    }
  }
  // An island without UV area that only touches another by position takes its tangent, too.
  Mesh two = make_grid(1, 1, on_plane);
  two.positions.insert(two.positions.end(), {{1, 0, 0}, {1, 1, 0}, {2, 0, 0}});
  two.uvs.resize(7, Vec2f(0, 0));
  two.triangles.push_back({4, 6, 5});
  compute_tangents(two);
  for (const std::size_t i : {4u, 5u, 6u}) EXPECT_LT((tangent(two, i) - Vec3f::UnitX()).norm(), 1e-5f) << i;
}

TEST(Tangents, VerticesBetweenOppositeOnesTakeOneOfThem) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
  mesh.normals.assign(4, Vec3f::UnitZ());
  mesh.tangents = {{1, 0, 0, -1}, {0, 0, 0, 0}, {-1, 1e-6f, 0, -1}, {0, 0, 0, 0}};
  fill_tangents(mesh, {1, 0, 1, 0});
  for (const std::size_t i : {1u, 3u}) {
    EXPECT_NEAR(std::abs(mesh.tangents[i].x()), 1, 1e-3) << i;
    EXPECT_EQ(mesh.tangents[i].w(), -1) << i;
  }
}

TEST(Tangents, OfASliverDoNotDisturbItsNeighbours) {
  Mesh mesh = make_grid(4, 4, on_plane);
  // A sliver between the vertices of one row, with UVs that contradict the plane's.
  mesh.positions.emplace_back(0.625f, 0.5f + 1e-8f, 0);
  mesh.uvs.emplace_back(-400.0f, 90.0f);
  mesh.triangles.push_back({12, 13, 25});
  compute_tangents(mesh);
  for (std::size_t i = 0; i < 25; ++i) EXPECT_LT((tangent(mesh, i) - Vec3f::UnitX()).norm(), 1e-5f) << i;
}

TEST(Tangents, AMeshWithoutUvsIsAnErrorThatSaysWhatHelps) {
  Mesh mesh = make_grid(2, 2, on_plane);
  mesh.uvs.clear();
  try {
    compute_tangents(mesh);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no texture coordinates"), std::string::npos);
  }
  EXPECT_THROW(set_tangents_along(mesh, Vec3f::Zero()), Error);
  EXPECT_THROW(set_tangents_around(mesh, Vec3f::Zero(), Vec3f::Zero()), Error);
}

TEST(Tangents, ProceduralFieldsAreCirclesAndProjectedAxes) {
  Mesh mesh =
      make_grid(48, 24, [](double u, double v) { return Vec3(on_torus(u, v, 2, 0.5) + Vec3(5, 6, 7)); });
  mesh.uvs.clear();
  set_tangents_around(mesh, Vec3f(0, 3, 0), Vec3f(5, 0, 7));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f from_axis = mesh.positions[i] - Vec3f(5, mesh.positions[i].y(), 7);
    const Vec3f circle = Vec3f::UnitY().cross(from_axis).normalized();
    EXPECT_GT(tangent(mesh, i).dot(circle), 0.9999f);
  }
  set_tangents_along(mesh, Vec3f(0, 3, 0));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f n = mesh.normals[i];
    const Vec3f projected = Vec3f::UnitY() - n.y() * n;
    if (projected.norm() > 0.01f) {
      EXPECT_GT(tangent(mesh, i).dot(projected.normalized()), 0.9999f);
    }
  }
}

TEST(Tangents, TurnCounterClockwiseSeenFromOutside) {
  Mesh mesh = make_grid(2, 2, on_plane);
  compute_tangents(mesh);
  rotate_tangents(mesh, kPi / 2);
  for (const Vec4f& t : mesh.tangents) EXPECT_LT((t - Vec4f(0, 1, 0, 1)).norm(), 1e-6f);
  rotate_tangents(mesh, kPi / 4);
  for (const Vec4f& t : mesh.tangents)
    EXPECT_LT((t - Vec4f(-std::sqrt(0.5f), std::sqrt(0.5f), 0, 1)).norm(), 1e-6f);
}

}  // namespace
}  // namespace sateen::geometry
