// SPDX-License-Identifier: MIT
#include "sateen/geometry/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/error.h"
#include "sateen/geometry/tangent_fill.h"
#include "sateen/geometry/weld.h"

namespace sateen::geometry {
namespace {

// Twice the area over the square of the longest side, below which a triangle is a sliver: its gradient is
// rounding noise.
constexpr double kSliver = 1e-5;
constexpr double kUvSliver = 1e-6;
// Length of a sum of vectors over the sum of their lengths, below which they are said to cancel.
constexpr double kCancel = 1e-3;
// The same, below which the two orientations of a mirrored vertex are kept apart.
constexpr double kMirrored = 0.5;
// Length of the part of a unit field across the normal, below which the field faces the normal.
constexpr double kFacing = 1e-3;

Vec3 corner(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.positions[vertex].cast<double>();
}

// Area times the gradients of u and v over a triangle; false for slivers and triangles without UV area.
struct Gradients {
  Vec3 u;
  Vec3 v;
  bool mirrored = false;  // UVs run clockwise
};

bool gradients(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, Gradients& result) {
  const Vec3 a = corner(mesh, t[1]) - corner(mesh, t[0]);
  const Vec3 b = corner(mesh, t[2]) - corner(mesh, t[0]);
  const Vec3 cross = a.cross(b);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  if (!(cross.norm() > kSliver * longest)) return false;
  const Vec2 origin = mesh.uvs[t[0]].cast<double>();
  const Vec2 da = mesh.uvs[t[1]].cast<double>() - origin;
  const Vec2 db = mesh.uvs[t[2]].cast<double>() - origin;
  const double uv_cross = da.x() * db.y() - da.y() * db.x();
  const double uv_longest = std::max({da.squaredNorm(), db.squaredNorm(), (db - da).squaredNorm()});
  if (!(std::abs(uv_cross) > kUvSliver * uv_longest)) return false;
  // The vector g of the plane with g . a = da and g . b = db, times the area |cross| / 2.
  const Vec3 normal = cross.normalized();
  const Vec3 along_a = b.cross(normal) / 2;
  const Vec3 along_b = normal.cross(a) / 2;
  result = {da.x() * along_a + db.x() * along_b, da.y() * along_a + db.y() * along_b, uv_cross < 0};
  return true;
}

// What the triangles around a vertex say of u and v, kept apart by the orientation of their UVs.
struct VertexGradients {
  std::array<Vec3f, 2> u{Vec3f::Zero(), Vec3f::Zero()};
  std::array<Vec3f, 2> v{Vec3f::Zero(), Vec3f::Zero()};
  float length = 0;  // of the gradients of u, summed
};

template <class T>
void repeat(std::vector<T>& values, std::uint32_t index) {
  if (!values.empty()) values.push_back(T(values[index]));
}

// Where mirrored halves meet in shared vertices their gradients of u cancel: such vertices are split, the
// copy goes to the clockwise half.
void split_mirrored(Mesh& mesh, std::vector<VertexGradients>& sums) {
  std::vector<std::uint32_t> copy(sums.size(), 0);
  bool any = false;
  for (std::uint32_t i = 0; i < copy.size(); ++i) {
    VertexGradients& sum = sums[i];
    const float apart = sum.u[0].norm() + sum.u[1].norm();
    if (sum.u[0].isZero(0) || sum.u[1].isZero(0) || (sum.u[0] + sum.u[1]).norm() > kMirrored * apart)
      continue;
    any = true;
    copy[i] = static_cast<std::uint32_t>(mesh.positions.size());
    repeat(mesh.positions, i);
    repeat(mesh.normals, i);
    repeat(mesh.uvs, i);
    repeat(mesh.occlusion, i);
    repeat(mesh.curvature, i);
    VertexGradients other = sum;
    other.u[0] = other.v[0] = sum.u[1] = sum.v[1] = Vec3f::Zero();
    sums.push_back(other);
  }
  if (!any) return;
  Gradients found;
  for (auto& triangle : mesh.triangles) {
    if (!gradients(mesh, triangle, found) || !found.mirrored) continue;
    for (std::uint32_t& vertex : triangle) {
      if (vertex < copy.size() && copy[vertex] != 0) vertex = copy[vertex];
    }
  }
}

// The tangent along `direction` made orthogonal to the normal; false when there is nothing left of it.
bool set_tangent(Mesh& mesh, std::size_t vertex, const Vec3& direction, float w) {
  const double length = direction.norm();
  if (!(length > 0) || !std::isfinite(length)) return false;
  const Vec3 normal = mesh.normals[vertex].cast<double>();
  const Vec3 tangent = across(direction / length, normal);
  if (tangent.norm() < kFacing) return false;
  mesh.tangents[vertex] << across(tangent.normalized(), normal).normalized().cast<float>(), w;
  return true;
}

}  // namespace

void compute_normals(Mesh& mesh) {
  if (!mesh.normals.empty()) return;
  const std::vector<std::uint32_t> weld = weld_positions(mesh.positions);
  const auto sums_over = [&](const auto& target) {
    std::vector<Vec3> sums(mesh.positions.size(), Vec3::Zero());
    for (const auto& t : mesh.triangles) {
      const Vec3 origin = corner(mesh, t[0]);
      const Vec3 cross = (corner(mesh, t[1]) - origin).cross(corner(mesh, t[2]) - origin);
      for (const std::uint32_t vertex : t) sums[target(vertex)] += cross;
    }
    return sums;
  };
  const std::vector<Vec3> sums = sums_over([&](std::uint32_t vertex) { return weld[vertex]; });
  // Two sheets back to back cancel at their common positions: each vertex then keeps its own triangles'
  // normal.
  std::vector<Vec3> own;
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3 sum = sums[weld[i]];
    if (!(sum.norm() > 0)) {
      if (own.empty()) own = sums_over([](std::uint32_t vertex) { return vertex; });
      sum = own[i];
    }
    mesh.normals[i] = sum.norm() > 0 ? Vec3f(sum.normalized().cast<float>()) : Vec3f::UnitZ();
  }
}

void compute_tangents(Mesh& mesh) {
  if (mesh.uvs.empty()) {
    throw Error(
        "the mesh has no texture coordinates, from which tangents follow; unwrap it, or choose a procedural "
        "tangent field");
  }
  compute_normals(mesh);
  mesh.tangents.clear();
  std::vector<VertexGradients> sums(mesh.positions.size());
  Gradients found;
  for (const auto& triangle : mesh.triangles) {
    if (!gradients(mesh, triangle, found)) continue;
    const std::size_t side = found.mirrored ? 1 : 0;
    for (const std::uint32_t vertex : triangle) {
      sums[vertex].u[side] += found.u.cast<float>();
      sums[vertex].v[side] += found.v.cast<float>();
      sums[vertex].length += static_cast<float>(found.u.norm());
    }
  }
  split_mirrored(mesh, sums);

  mesh.tangents.resize(mesh.positions.size());
  std::vector<char> known(mesh.positions.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Vec3 u = (sums[i].u[0] + sums[i].u[1]).cast<double>();
    const Vec3 v = (sums[i].v[0] + sums[i].v[1]).cast<double>();
    if (u.norm() < kCancel * static_cast<double>(sums[i].length)) continue;
    const Vec3 normal = mesh.normals[i].cast<double>();
    const float w = normal.cross(u).dot(v) < 0 ? -1.0f : 1.0f;
    known[i] = set_tangent(mesh, i, u, w) ? 1 : 0;
  }
  fill_tangents(mesh, known);
}

void set_tangents_around(Mesh& mesh, const Vec3f& axis, const Vec3f& centre) {
  if (!(axis.norm() > 0)) throw Error("the axis of a tangent field must not be zero");
  compute_normals(mesh);
  const Vec3 unit = axis.cast<double>().normalized();
  double extent = 0;
  for (const Vec3f& p : mesh.positions) extent = std::max(extent, (p - centre).cast<double>().norm());
  mesh.tangents.resize(mesh.positions.size());
  std::vector<char> known(mesh.positions.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Vec3 circle = unit.cross((mesh.positions[i] - centre).cast<double>());
    if (circle.norm() > 1e-6 * extent) known[i] = set_tangent(mesh, i, circle, 1) ? 1 : 0;
  }
  fill_tangents(mesh, known);
}

void set_tangents_along(Mesh& mesh, const Vec3f& axis) {
  if (!(axis.norm() > 0)) throw Error("the axis of a tangent field must not be zero");
  compute_normals(mesh);
  mesh.tangents.resize(mesh.positions.size());
  std::vector<char> known(mesh.positions.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    known[i] = set_tangent(mesh, i, axis.cast<double>(), 1) ? 1 : 0;
  }
  fill_tangents(mesh, known);
}

void rotate_tangents(Mesh& mesh, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    const Vec3 normal = mesh.normals[i].cast<double>();
    const Vec3 tangent = mesh.tangents[i].head<3>().cast<double>();
    const Vec3 turned = cosine * tangent + sine * normal.cross(tangent);
    mesh.tangents[i].head<3>() = turned.normalized().cast<float>();
  }
}

}  // namespace sateen::geometry
