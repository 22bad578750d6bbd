// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "sateen/capture/table/rectify.h"

namespace sateen::capture {

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

/// Cosine and sine: what one angle has for every texel is computed once.
inline Vec2 direction_of(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// Where on the turning body a normal lies: its (x, y) in the axis frame at angle 0, for a body turned by the
/// angle of which `turned` is the direction_of.
Vec2 body_point(const AxisFrame& axes, const Vec3& normal, const Vec2& turned);

/// The tangent's angle in the table as the body turns. The surface is prepared as section 5.1 asks: tangents
/// run like the parallels of a globe whose pole lies across the turning axis. One instance serves one texel.
class TangentAngle {
 public:
  TangentAngle(const SeenPoint& point, TableFrame frame, const AxisFrame& axes);
  /// The tangent in the middle of the disc points to `first` (radians) at angle 0 in the picture plane: where
  /// the globe's pole then is, as direction_of.
  static Vec2 pole(double first, double angle) { return direction_of(first + kPi / 2 + angle); }
  /// In turns, [0, 1), when the pole is at `pole`.
  double at(const Vec2& pole) const;

 private:
  Vec2 cosine_;
  Vec2 sine_;
};

}  // namespace sateen::capture
