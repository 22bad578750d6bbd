// SPDX-License-Identifier: MIT
#include "sateen/capture/table/stack.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::capture {
namespace {

const double kBelowOne = std::nextafter(1.0, 0.0);

}  // namespace

AxisFrame::AxisFrame(const Vec3& axis) {
  x = (Vec3::UnitX() - axis * axis.x()).normalized();
  y = axis.cross(x);
}

Vec2 body_point(const AxisFrame& axes, const Vec3& normal, const Vec2& turned) {
  const double x = normal.dot(axes.x);
  const double y = normal.dot(axes.y);
  return {turned.x() * x + turned.y() * y, -turned.y() * x + turned.x() * y};
}

TangentAngle::TangentAngle(const SeenPoint& point, TableFrame frame, const AxisFrame& axes) {
  const Mat3 to_table = table_frame(point, frame);
  cosine_ = (to_table * axes.x.cross(point.normal)).head<2>();
  sine_ = (to_table * axes.y.cross(point.normal)).head<2>();
}

double TangentAngle::at(const Vec2& pole) const {
  const Vec2 tangent = pole.x() * cosine_ + pole.y() * sine_;
  const double turns = std::atan2(tangent.y(), tangent.x()) / (2 * kPi);
  return turns < 0 ? std::min(turns + 1, kBelowOne) : turns;
}

}  // namespace sateen::capture
