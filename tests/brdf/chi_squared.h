// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::test {

/// How far directions that `sample` draws are from the density `pdf` (1/sr, over the whole sphere), in
/// standard deviations: chi-squared over equal-area cells in (z, phi), densities integrated cell by cell,
/// rare cells pooled; Wilson and Hilferty's cube root makes it nearly normal.
inline double deviation_from_density(const std::function<Vec3()>& sample,
                                     const std::function<double(const Vec3&)>& pdf, int samples) {
  constexpr int kZ = 20;
  constexpr int kPhi = 24;
  constexpr int kSub = 24;
  std::vector<double> observed(kZ * kPhi, 0);
  for (int i = 0; i < samples; ++i) {
    const Vec3 u = sample();
    const int z = std::clamp(static_cast<int>((u.z() + 1) / 2 * kZ), 0, kZ - 1);
    const int phi =
        std::clamp(static_cast<int>((std::atan2(u.y(), u.x()) / kPi + 1) / 2 * kPhi), 0, kPhi - 1);
    observed[static_cast<std::size_t>(z * kPhi + phi)] += 1;
  }
  double chi_squared = 0;
  double pooled_expected = 0;
  double pooled_observed = 0;
  int cells = 0;
  const auto add = [&](double expected, double seen) {
    chi_squared += (seen - expected) * (seen - expected) / expected;
    ++cells;
  };
  for (int z = 0; z < kZ; ++z) {
    for (int phi = 0; phi < kPhi; ++phi) {
      double density = 0;
      for (int a = 0; a < kSub; ++a) {
        for (int b = 0; b < kSub; ++b) {
          const double c = -1 + 2 * (z + (a + 0.5) / kSub) / kZ;
          const double angle = -kPi + 2 * kPi * (phi + (b + 0.5) / kSub) / kPhi;
          const double s = std::sqrt(1 - c * c);
          density += pdf(Vec3(s * std::cos(angle), s * std::sin(angle), c));
        }
      }
      const double expected = density / (kSub * kSub) * (4 * kPi / (kZ * kPhi)) * samples;
      const double seen = observed[static_cast<std::size_t>(z * kPhi + phi)];
      if (expected < 10) {
        pooled_expected += expected;
        pooled_observed += seen;
      } else {
        add(expected, seen);
      }
    }
  }
  if (pooled_expected > 10) add(pooled_expected, pooled_observed);
  const double n = cells - 1;
  return (std::cbrt(chi_squared / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
}

}  // namespace sateen::test
