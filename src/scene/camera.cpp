// SPDX-License-Identifier: MIT
#include "sateen/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/core/error.h"

namespace sateen::scene {
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

/// Along one picture axis: the camera's place on it, and how far away (perspective) or wide (orthographic) it
/// must see. The camera at `centre` and distance d sees x if |x - centre| <= slope (d - z): the bounds of d
/// from both sides are equal at the best centre. For parallel rays the widest extent takes the place of the
/// distance.
class AxisFit {
 public:
  AxisFit(bool perspective, double slope) : perspective_(perspective), slope_(slope) {}

  void add(double x, double z) {
    const double depth = perspective_ ? z * slope_ : 0;
    up_ = std::max(up_, depth + x);
    down_ = std::max(down_, depth - x);
  }
  double centre() const { return (up_ - down_) / 2; }
  double half_extent() const { return (up_ + down_) / 2; }
  double distance() const { return half_extent() / slope_; }

 private:
  bool perspective_;
  double slope_;
  double up_ = -std::numeric_limits<double>::infinity();
  double down_ = -std::numeric_limits<double>::infinity();
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

  const bool perspective = camera.kind == Camera::Kind::perspective;
  const double free = 1 + 2 * camera.margin;
  const double tan_y = std::tan(camera.field_of_view / 2);
  const double tan_x = tan_y * aspect;
  AxisFit horizontal(perspective, tan_x / free);
  AxisFit vertical(perspective, tan_y / free);
  const Vec3 middle = bounds(mesh, Mat3::Identity()).center();
  double back = 0;
  double front = 0;
  for (const Mat3& rotation : rotations) {
    for (const Vec3f& position : mesh.positions) {
      const Vec3 p = rotation * (position.cast<double>() - middle);
      horizontal.add(p.x(), p.z());
      vertical.add(p.y(), p.z());
      back = std::min(back, p.z());
      front = std::max(front, p.z());
    }
  }
  const double half_y = free * std::max(vertical.half_extent(), horizontal.half_extent() / aspect);
  const double size = std::max(half_y, front - back);
  // A spike towards the eye must not reach it.
  const double distance =
      perspective ? std::max({horizontal.distance(), vertical.distance(), front + size / 4}) : 0;
  const double near = distance - front - size * 0.1;
  const double far = distance - back + size * 0.1;
  const Mat4 clip_from_view = perspective ? perspective_matrix(tan_x, tan_y, near, far)
                                          : orthographic_matrix(half_y * aspect, half_y, -far, -near);
  const Vec3 eye(horizontal.centre(), vertical.centre(), distance);
  std::vector<View> views;
  for (const Mat3& rotation : rotations) {
    views.push_back({rigid(rotation, -eye - rotation * middle), clip_from_view, perspective});
  }
  return views;
}

}  // namespace sateen::scene
