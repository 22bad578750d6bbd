// SPDX-License-Identifier: MIT
#include "sateen/geometry/curvature.h"

#include <array>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/geometry/tangents.h"
#include "sateen/geometry/weld.h"

namespace sateen::geometry {
namespace {

// An orthonormal pair in a plane.
struct Frame {
  Vec3 u;
  Vec3 v;
  Vec3 normal() const { return u.cross(v); }
};

Frame frame_of(const Vec3& normal) {
  Frame frame;
  frame_around(normal, frame.u, frame.v);
  return frame;
}

// The frame turned, as little as possible, into the plane of `normal`.
Frame turned(const Frame& frame, const Vec3& normal) {
  const Mat3 rotation = rotation_between(frame.normal(), normal);
  return {rotation * frame.u, rotation * frame.v};
}

// Least-squares second fundamental form of a triangle in `frame`: II e = dn over its three edges.
bool triangle_form(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n, const Frame& frame,
                   Mat2& form) {
  Mat3 lhs = Mat3::Zero();
  Vec3 rhs = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = p[(i + 2) % 3] - p[(i + 1) % 3];
    const Vec3 change = n[(i + 2) % 3] - n[(i + 1) % 3];
    const double eu = edge.dot(frame.u);
    const double ev = edge.dot(frame.v);
    const Vec3 row_u(eu, ev, 0);
    const Vec3 row_v(0, eu, ev);
    lhs += row_u * row_u.transpose() + row_v * row_v.transpose();
    rhs += row_u * change.dot(frame.u) + row_v * change.dot(frame.v);
  }
  const Vec3 x = lhs.inverse() * rhs;
  if (!x.allFinite()) return false;
  form << x[0], x[1], x[1], x[2];
  return true;
}

// The share of the triangle's area nearest to each corner (Meyer et al. 2003): Voronoi where acute, else half
// to the obtuse corner.
std::array<double, 3> corner_areas(const std::array<Vec3, 3>& p) {
  const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
  std::array<double, 3> cotangent{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = p[(i + 1) % 3] - p[i];
    const Vec3 b = p[(i + 2) % 3] - p[i];
    if (a.dot(b) <= 0) {
      std::array<double, 3> shares{area / 4, area / 4, area / 4};
      shares[i] = area / 2;
      return shares;
    }
    cotangent[i] = a.dot(b) / (2 * area);
  }
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    shares[i] = (cotangent[k] * (p[j] - p[i]).squaredNorm() + cotangent[j] * (p[k] - p[i]).squaredNorm()) / 8;
  }
  return shares;
}

}  // namespace

PrincipalCurvatures compute_curvature(Mesh& mesh) {
  compute_normals(mesh);
  const std::size_t count = mesh.positions.size();
  const std::vector<std::uint32_t> weld = weld_positions(mesh.positions);
  // Upper triangle (uu, uv, vv) of the form in frame_of(normal) of the welded vertex, times area; and the
  // area.
  std::vector<Vec4> sums(count, Vec4::Zero());
  const auto normal_of = [&](std::uint32_t vertex) { return Vec3(mesh.normals[vertex].cast<double>()); };

  for (const auto& t : mesh.triangles) {
    std::array<Vec3, 3> p;
    std::array<Vec3, 3> n;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.positions[t[i]].cast<double>();
      n[i] = normal_of(t[i]);
    }
    const Vec3 cross = (p[1] - p[0]).cross(p[2] - p[0]);
    if (!(cross.norm() > 0)) continue;
    const Frame frame = frame_of(cross.normalized());
    Mat2 form;
    if (!triangle_form(p, n, frame, form)) continue;
    const std::array<double, 3> areas = corner_areas(p);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = weld[t[i]];
      const Frame own = frame_of(normal_of(vertex));
      const Frame here = turned(own, cross.normalized());
      const Vec2 u(here.u.dot(frame.u), here.u.dot(frame.v));
      const Vec2 v(here.v.dot(frame.u), here.v.dot(frame.v));
      sums[vertex] += areas[i] * Vec4(u.dot(form * u), u.dot(form * v), v.dot(form * v), 1);
    }
  }

  PrincipalCurvatures result;
  result.k1.resize(count);
  result.k2.resize(count);
  result.direction1.resize(count);
  result.direction2.resize(count);
  mesh.curvature.resize(count);
  mesh.curvature_forms.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec4& sum = sums[weld[i]];
    const Vec3 form = sum.w() > 0 ? Vec3(sum.head<3>() / sum.w()) : Vec3(Vec3::Zero());
    const Frame own = frame_of(normal_of(weld[i]));
    // Eigenvalues and axis of the symmetric 2 x 2 matrix (a, b; b, c).
    const double mean = (form[0] + form[2]) / 2;
    const double half = (form[0] - form[2]) / 2;
    const double radius = std::hypot(half, form[1]);
    const double angle = std::atan2(form[1], half) / 2 + (mean < 0 ? kPi / 2 : 0);
    const Vec3 first = std::cos(angle) * own.u + std::sin(angle) * own.v;
    result.k1[i] = static_cast<float>(mean < 0 ? mean - radius : mean + radius);
    result.k2[i] = static_cast<float>(mean < 0 ? mean + radius : mean - radius);
    result.direction1[i] = first.cast<float>();
    result.direction2[i] = own.normal().cross(first).cast<float>();
    mesh.curvature[i] = static_cast<float>(mean);
    const Mat3 bent = form[0] * own.u * own.u.transpose() + form[2] * own.v * own.v.transpose() +
                      form[1] * (own.u * own.v.transpose() + own.v * own.u.transpose());
    mesh.curvature_forms[i] = {Vec3(bent.diagonal()).cast<float>(),
                               Vec3(bent(1, 2), bent(0, 2), bent(0, 1)).cast<float>()};
  }
  return result;
}

}  // namespace sateen::geometry
