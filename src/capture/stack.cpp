// SPDX-License-Identifier: MIT
#include "sateen/capture/stack.h"

#include <cmath>

#include "sateen/core/direction.h"

namespace sateen {

AxisFrame::AxisFrame(const Vec3& axis) {
  x = (Vec3::UnitX() - axis * axis.x()).normalized();
  y = axis.cross(x);
}

Vec2 body_point(const AxisFrame& axes, const Vec3& normal, double angle) {
  const double x = normal.dot(axes.x);
  const double y = normal.dot(axes.y);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * x + s * y, -s * x + c * y};
}

TangentAngle::TangentAngle(const SeenPoint& point, TableFrame frame, const AxisFrame& axes) {
  const Mat3 to_table = table_frame(point, frame);
  cosine_ = (to_table * axes.x.cross(point.normal)).head<2>();
  sine_ = (to_table * axes.y.cross(point.normal)).head<2>();
}

double TangentAngle::at(double first, double angle) const {
  const double pole = first + kPi / 2 + angle;
  const Vec2 tangent = std::cos(pole) * cosine_ + std::sin(pole) * sine_;
  return wrap(std::atan2(tangent.y(), tangent.x()) / (2 * kPi));
}

}  // namespace sateen
