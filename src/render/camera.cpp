// SPDX-License-Identifier: MIT
#include "sateen/render/camera.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/error.h"

namespace sateen {
namespace {

Mat4 rigid(const Mat3& rotation, const Vec3& translation) {
  Mat4 matrix = Mat4::Identity();
  matrix.topLeftCorner<3, 3>() = rotation;
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

/// Looking down -z from the origin; near and far are distances.
Mat4 perspective_matrix(double tan_x, double tan_y, double near, double far) {
  Mat4 m = Mat4::Zero();
  m(0, 0) = 1 / tan_x;
  m(1, 1) = 1 / tan_y;
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2 * far * near / (far - near);
  m(3, 2) = -1;
  return m;
}

/// Half extents x and y around the z axis; z from `back` to `front` is visible.
Mat4 orthographic_matrix(double half_x, double half_y, double back, double front) {
  Mat4 m = Mat4::Identity();
  m(0, 0) = 1 / half_x;
  m(1, 1) = 1 / half_y;
  m(2, 2) = -2 / (front - back);
  m(2, 3) = (front + back) / (front - back);
  return m;
}

using Box = Eigen::AlignedBox3d;

Box bounds(const Mesh& mesh, const Mat3& rotation) {
  Box box;
  for (const Vec3f& p : mesh.positions) box.extend(rotation * p.cast<double>());
  return box;
}

/// How far and how wide the camera must be to see all poses.
struct Extent {
  double half_x = 0;    ///< largest |x|
  double half_y = 0;    ///< largest |y|
  double distance = 0;  ///< of the eye from the pivot for every point to be in the pyramid of view
  double front = 0;     ///< largest z relative to the pivot
  double back = 0;      ///< smallest
};

}  // namespace

std::vector<View> frame_object(const Mesh& mesh, const Camera& camera, std::span<const Mat3> rotations,
                               double aspect) {
  if (mesh.positions.empty()) throw Error("the mesh has no vertices");
  if (!(bounds(mesh, Mat3::Identity()).diagonal().norm() > 0)) throw Error("the mesh has no extent");
  if (camera.kind == Camera::Kind::view_space) {
    std::vector<View> views;
    for (const Mat3& rotation : rotations) {
      const Box box = bounds(mesh, rotation);
      const double slack = 1 + box.diagonal().z();
      views.push_back({rigid(rotation, Vec3::Zero()),
                       orthographic_matrix(1, 1, box.min().z() - slack, box.max().z() + slack), false});
    }
    return views;
  }

  const double free = 1 + 2 * camera.margin;
  const double tan_y = std::tan(camera.field_of_view / 2);
  const double tan_x = tan_y * aspect;
  std::vector<Vec3> pivots;
  Extent extent;
  for (const Mat3& rotation : rotations) {
    const Vec3 pivot = rotations.size() == 1 ? bounds(mesh, rotation).center()
                                             : Vec3(rotation * bounds(mesh, Mat3::Identity()).center());
    pivots.push_back(pivot);
    for (const Vec3f& position : mesh.positions) {
      const Vec3 p = rotation * position.cast<double>() - pivot;
      const double x = std::abs(p.x()) * free;
      const double y = std::abs(p.y()) * free;
      extent.half_x = std::max(extent.half_x, x);
      extent.half_y = std::max(extent.half_y, y);
      extent.distance = std::max(extent.distance, p.z() + std::max(x / tan_x, y / tan_y));
      extent.front = std::max(extent.front, p.z());
      extent.back = std::min(extent.back, p.z());
    }
  }
  const double size = std::max({extent.half_x, extent.half_y, extent.front - extent.back});
  const bool perspective = camera.kind == Camera::Kind::perspective;
  // A spike towards the eye must not reach it.
  const double distance = perspective ? std::max(extent.distance, extent.front + size / 4) : 0;
  const double front = extent.front + size * 0.1 - distance;
  const double back = extent.back - size * 0.1 - distance;
  const double half_y = std::max(extent.half_y, extent.half_x / aspect);
  const Mat4 clip_from_view = perspective ? perspective_matrix(tan_x, tan_y, -front, -back)
                                          : orthographic_matrix(half_y * aspect, half_y, back, front);
  std::vector<View> views;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    views.push_back({rigid(rotations[i], Vec3(0, 0, -distance) - pivots[i]), clip_from_view, perspective});
  }
  return views;
}

}  // namespace sateen
