// SPDX-License-Identifier: MIT
#include "sateen/capture/turning/angles.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::capture {

std::vector<double> unwrapped(std::span<const double> angles) {
  std::vector<double> result;
  for (const double angle : angles) {
    result.push_back(result.empty() ? angle : result.back() + std::remainder(angle - result.back(), 2 * kPi));
  }
  return result;
}

EqualSteps equal_steps(std::span<const int> indices, std::span<const double> angles, int sequence,
                       double noise) {
  EqualSteps result;
  const std::size_t n = angles.size();
  if (n < 12) return result;
  const std::vector<double> y = unwrapped(angles);
  double mean_x = 0;
  double mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += indices[i] / static_cast<double>(n);
    mean_y += y[i] / static_cast<double>(n);
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    xx += (indices[i] - mean_x) * (indices[i] - mean_x);
    xy += (indices[i] - mean_x) * (y[i] - mean_y);
  }
  result.step = xy / xx;
  double worst = 0;
  const double turns = result.step * sequence / (2 * kPi);
  const double whole = std::round(turns);
  if (whole != 0 && std::abs(turns - whole) * 2 * kPi < 4 * noise) result.step = whole * 2 * kPi / sequence;
  result.first = mean_y - result.step * mean_x;
  for (std::size_t i = 0; i < n; ++i) {
    const double off = std::abs(y[i] - result.first - result.step * indices[i]);
    result.rms += off * off / static_cast<double>(n);
    worst = std::max(worst, off);
  }
  result.rms = std::sqrt(result.rms);
  result.found = result.rms < noise && worst < 5 * noise;
  return result;
}

Coverage coverage(std::span<const double> angles, double period) {
  std::vector<double> sorted;
  for (const double angle : angles) sorted.push_back(wrap(angle, period));
  std::ranges::sort(sorted);
  std::vector<double> gaps;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    gaps.push_back(i + 1 < sorted.size() ? sorted[i + 1] - sorted[i] : sorted[0] + period - sorted[i]);
  }
  std::ranges::sort(gaps);
  if (gaps.empty()) return {period, period};
  return {gaps.back(), gaps[gaps.size() / 2]};
}

}  // namespace sateen::capture
