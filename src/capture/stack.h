// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sateen/capture/rectify.h"

namespace sateen {

/// All rectified frames of a capture, ascending in angle, with what ties them together.
struct RectifiedStack {
  int size = 0;
  Vec3 axis{0, 0, 1};  ///< of the turning, view space, unit, towards the camera
  TableFrame frame = TableFrame::eye;
  std::vector<SeenPoint> points;  ///< per texel, row 0 on top
  std::vector<RectifiedFrame> frames;
  std::vector<double> angles;  ///< radians turned counter-clockwise about the axis, in [0, 2 pi)
};

/// The directions across the axis from which angles about it are measured: `x` is view space's x made
/// orthogonal to it.
struct AxisFrame {
  Vec3 x;
  Vec3 y;
  explicit AxisFrame(const Vec3& axis);
};

/// Where on the turning body a normal lies: its (x, y) in the axis frame at angle 0, for a body turned by
/// `angle`.
Vec2 body_point(const AxisFrame& axes, const Vec3& normal, double angle);

/// The tangent's angle in the table as the body turns. The surface is prepared as section 5.1 asks: tangents
/// run like the parallels of a globe whose pole lies across the turning axis. One instance serves one texel.
class TangentAngle {
 public:
  TangentAngle(const SeenPoint& point, TableFrame frame, const AxisFrame& axes);
  /// In turns, [0, 1); `first` (radians) is the picture-plane angle of the tangent in the middle of the disc
  /// at angle 0.
  double at(double first, double angle) const;

 private:
  Vec2 cosine_;
  Vec2 sine_;
};

}  // namespace sateen
