// SPDX-License-Identifier: MIT
#include "sateen/matcap/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sateen::matcap {

double OrientedBox::reach() const {
  return std::sqrt(half[0].squaredNorm() + half[1].squaredNorm() + half[2].squaredNorm());
}

Vec3 QuarterMeans::difference(std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1) const {
  const double a = count_[a0] + count_[a1];
  const double b = count_[b0] + count_[b1];
  if (a == 0 || b == 0) return Vec3::Zero();
  return (sum_[b0] + sum_[b1]) / b - (sum_[a0] + sum_[a1]) / a;
}

std::array<Vec3, 3> QuarterMeans::frame() const {
  Vec3 across = difference(0, 2, 1, 3);
  Vec3 down = difference(0, 1, 2, 3);
  if (!(across.squaredNorm() > 0)) std::swap(across, down);
  if (!(across.squaredNorm() > 0)) return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const Vec3 u = across.normalized();
  Vec3 w = u.cross(down);
  w = w.squaredNorm() > 1e-18 * down.squaredNorm() ? w.normalized() : u.unitOrthogonal();
  return {u, w.cross(u), w};
}

void BoxBuilder::add(const Vec3& point) {
  const Vec3 p(point.dot(frame_[0]), point.dot(frame_[1]), point.dot(frame_[2]));
  low_ = low_.cwiseMin(p);
  high_ = high_.cwiseMax(p);
}

void BoxBuilder::add(const OrientedBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& f = frame_[axis];
    const double middle = box.centre.dot(f);
    const double reach =
        std::abs(box.half[0].dot(f)) + std::abs(box.half[1].dot(f)) + std::abs(box.half[2].dot(f));
    const auto i = static_cast<Eigen::Index>(axis);
    low_[i] = std::min(low_[i], middle - reach);
    high_[i] = std::max(high_[i], middle + reach);
  }
}

OrientedBox BoxBuilder::box() const {
  OrientedBox result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    result.centre += (low_[i] + high_[i]) / 2 * frame_[axis];
    result.half[axis] = (high_[i] - low_[i]) / 2 * frame_[axis];
  }
  return result;
}

}  // namespace sateen::matcap
