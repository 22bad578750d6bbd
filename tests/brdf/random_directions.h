// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "sateen/core/vector.h"

namespace sateen::test {

inline Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// Even over the upper hemisphere, at least `lowest` above the horizon.
inline Vec3 random_up(std::mt19937& random, double lowest = 0) {
  std::uniform_real_distribution<double> uniform;
  const double z = lowest + (1 - lowest) * uniform(random);
  const double phi = 2 * kPi * uniform(random);
  return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

inline double random_in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// The integral of f over the upper hemisphere by the midpoint rule in (z, phi): slow, plain, independent of
/// quadrature.h.
template <typename F>
double midpoint_hemisphere(const F& f, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = (i + 0.5) / steps;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < 2 * steps; ++j) {
      const double phi = kPi * (j + 0.5) / steps;
      sum += f(Vec3(r * std::cos(phi), r * std::sin(phi), z));
    }
  }
  return sum * kPi / (static_cast<double>(steps) * steps);
}

}  // namespace sateen::test
