// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "sateen/core/vector.h"

namespace sateen::matcap {

/// A box that stands as its content does: a centre and three half axes at right angles to each other.
struct OrientedBox {
  Vec3 centre{0, 0, 0};
  std::array<Vec3, 3> half{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};

  /// Half the diagonal.
  double reach() const;
};

/// Averages of the things in each quarter of a square (left upper, right upper, left lower, right lower), and
/// the frame that stands along them.
class QuarterMeans {
 public:
  void add(std::size_t quarter, const Vec3& point) {
    sum_[quarter] += point;
    count_[quarter] += 1;
  }
  /// Unit vectors at right angles: from left to right, from top to bottom, and across both.
  std::array<Vec3, 3> frame() const;

 private:
  Vec3 difference(std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1) const;

  std::array<Vec3, 4> sum_{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  std::array<double, 4> count_{};
};

/// The smallest box along a frame around what is added.
class BoxBuilder {
 public:
  explicit BoxBuilder(const std::array<Vec3, 3>& frame) : frame_(frame) {}
  void add(const Vec3& point);
  void add(const OrientedBox& box);
  OrientedBox box() const;

 private:
  std::array<Vec3, 3> frame_;
  Vec3 low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high_ = -low_;
};

}  // namespace sateen::matcap
