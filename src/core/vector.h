// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <numbers>

namespace sateen {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Vec4f = Eigen::Vector4f;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;

/// IEEE 754 binary16, the texel type of tables in memory.
using Half = Eigen::half;

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) {
  return degrees * (kPi / 180);
}
constexpr double degrees(double radians) {
  return radians * (180 / kPi);
}

}  // namespace sateen
