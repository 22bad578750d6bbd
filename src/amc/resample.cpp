// SPDX-License-Identifier: MIT
#include "sateen/amc/resample.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::amc {
namespace {

/// Angle from a to b going up, in [0, 1).
double ahead(double a, double b) {
  return wrap(b - a);
}

/// Non-uniform Catmull-Rom, `offset` turns past frame `before`: cubic Hermite with three-point slopes.
FrameWeights cubic_weights(std::span<const double> angles, int before, double offset) {
  const int n = static_cast<int>(angles.size());
  const int i[4] = {(before + n - 1) % n, before, (before + 1) % n, (before + 2) % n};
  const auto at = [&](int j) { return angles[static_cast<std::size_t>(i[j])]; };
  const double h0 = ahead(at(0), at(1));
  const double h1 = ahead(at(1), at(2));
  const double h2 = ahead(at(2), at(3));
  const double t = offset / h1;
  const double t2 = t * t;
  const double t3 = t2 * t;
  double w[4] = {0, 2 * t3 - 3 * t2 + 1, -2 * t3 + 3 * t2, 0};
  // Slope at a knot: the neighbouring secants, each weighted by the other's length.
  const auto add_slope = [&](double share, int left, double a, double b) {
    const double scale = share * h1 / (a + b);
    w[left] -= scale * b / a;
    w[left + 1] += scale * (b / a - a / b);
    w[left + 2] += scale * a / b;
  };
  add_slope(t3 - 2 * t2 + t, 0, h0, h1);
  add_slope(t3 - t2, 1, h1, h2);
  FrameWeights weights;
  for (int j = 0; j < 4; ++j) {
    if (std::abs(w[j]) > 1e-12) weights.emplace_back(i[j], w[j]);
  }
  return weights;
}

}  // namespace

FrameWeights cyclic_weights(std::span<const double> angles, double angle, double spacing) {
  const int n = static_cast<int>(angles.size());
  const double wrapped = wrap(angle);
  const auto upper = std::upper_bound(angles.begin(), angles.end(), wrapped + 1e-12);
  const int before = (static_cast<int>(upper - angles.begin()) + n - 1) % n;
  const auto gap = [&](int i) {
    const double g =
        ahead(angles[static_cast<std::size_t>(i)], angles[static_cast<std::size_t>((i + 1) % n)]);
    return n == 1 ? 1 : g;
  };
  if (gap(before) > spacing * (1 - 1e-9)) {
    const double past = wrapped - angles[static_cast<std::size_t>(before)];
    const double offset = std::max(0.0, upper == angles.begin() ? past + 1 : past);
    if (n >= 4) return cubic_weights(angles, before, offset);
    const double t = offset / gap(before);
    return {{before, 1 - t}, {(before + 1) % n, t}};
  }
  FrameWeights weights;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double offset = ahead(wrapped, angles[static_cast<std::size_t>(i)]);
    const double distance = std::min(offset, 1 - offset);
    if (distance >= spacing) continue;
    // Each frame speaks for the stretch of angles nearest to it.
    const double stretch = (gap(i) + gap((i + n - 1) % n)) / 2;
    weights.emplace_back(i, (1 - distance / spacing) * stretch);
    sum += weights.back().second;
  }
  for (auto& [frame, weight] : weights) weight /= sum;
  return weights;
}

}  // namespace sateen::amc
