// SPDX-License-Identifier: MIT
#include "sateen/core/direction.h"

#include <cmath>

namespace sateen {

Vec3 normal_on_disc(const Vec2& disc) {
  const double r2 = disc.squaredNorm();
  if (r2 >= 1) {
    const Vec2 rim = disc / std::sqrt(r2);
    return {rim.x(), rim.y(), 0};
  }
  return {disc.x(), disc.y(), std::sqrt(1 - r2)};
}

Vec2 disc_of_pixel(int x, int y, int size) {
  return {2 * (x + 0.5) / size - 1, 1 - 2 * (y + 0.5) / size};
}

Vec2 pixel_of_disc(const Vec2& disc, int size) {
  return {(disc.x() + 1) / 2 * size, (1 - disc.y()) / 2 * size};
}

double tangent_angle(const Vec3& tangent) {
  return wrap(std::atan2(tangent.y(), tangent.x()) / (2 * kPi));
}

double wrap(double x, double period) {
  const double wrapped = x - std::floor(x / period) * period;
  return wrapped < period ? wrapped : 0;
}

Mat3 rotation_between(const Vec3& from, const Vec3& to) {
  // In the plane of both, from and the direction across it turn by the angle between them.
  const double cosine = from.dot(to);
  Vec3 across = to - cosine * from;
  const double sine = across.norm();
  if (sine < 1e-15) {
    Vec3 other;
    frame_around(from, across, other);
  } else {
    // Where the sine is small, rounding has left some of `from` in it.
    across = (across - across.dot(from) * from).normalized();
  }
  return Mat3::Identity() + sine * (across * from.transpose() - from * across.transpose()) +
         (cosine - 1) * (from * from.transpose() + across * across.transpose());
}

Mat3 eye_frame(const Vec3& towards_eye) {
  const double c = towards_eye.z();
  constexpr double kOpposite = -0.999;  // near it the axis of the rotation is badly known
  if (c < kOpposite) return rotation_between(towards_eye, Vec3::UnitZ());
  // Rodrigues' formula about towards_eye x z, whose length is the sine.
  const double x = towards_eye.x();
  const double y = towards_eye.y();
  const double k = 1 / (1 + c);
  Mat3 rotation;
  rotation << c + k * y * y, -k * x * y, -x,  //
      -k * x * y, c + k * x * x, -y,          //
      x, y, c;
  return rotation;
}

Vec3 seen_normal(const Vec3& eye_normal) {
  if (eye_normal.z() >= 0) return eye_normal;
  const double length = eye_normal.head<2>().norm();
  // Turned straight away: no point of the rim is nearer than another.
  if (length == 0) return {1, 0, 0};
  return {eye_normal.x() / length, eye_normal.y() / length, 0};
}

Vec3 perspective_equation4(const Vec3& direction, const Vec3& position) {
  const double x = position.x() / position.z();
  const double y = position.y() / position.z();
  return {(direction.x() - x * direction.z()) / std::sqrt(1 + x * x),
          (direction.y() - y * direction.z()) / std::sqrt(1 + y * y), direction.z()};
}

Mat3 rotation_xyz(const Vec3& angles) {
  return (Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

void frame_around(const Vec3& n, Vec3& tangent, Vec3& bitangent) {
  // Duff et al. 2017, Building an Orthonormal Basis, Revisited.
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  tangent = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
  bitangent = {b, sign + n.y() * n.y() * a, -n.y()};
}

}  // namespace sateen
