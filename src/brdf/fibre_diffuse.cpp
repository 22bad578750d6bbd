// SPDX-License-Identifier: MIT
#include "sateen/brdf/fibre_diffuse.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/quadrature.h"

namespace sateen::brdf {

namespace {

/// l . n_max: the length of the light's part across the fibre.
double across_fibre(const Vec3& light) {
  return std::hypot(light.y(), light.z());
}

}  // namespace

double fibre_diffuse(const Vec3& light) {
  if (light.z() < 0) return 0;
  // (l . n_max)(1 + n_max . n) with n_max = (0, l_y, l_z) / |(l_y, l_z)|: the division cancels.
  return (across_fibre(light) + light.z()) / kPi;
}

double fibre_diffuse_printed(const Vec3& light) {
  if (light.z() < 0) return 0;
  const double across = across_fibre(light);
  // n_min = l x n_max / |l x n_max| = sign(l.t) t x n_max, hence n_min . b = -sign(l.t) n_max . n.
  const double sign = light.x() < 0 ? -1 : 1;
  return (across + sign * light.z()) / kPi;
}

double fibre_diffuse_integral(const Vec3& light, double tolerance) {
  const auto lit = [&](double angle) {
    return std::max(0.0, light.z() * std::cos(angle) + light.y() * std::sin(angle));
  };
  // The lit range ends where the integrand has a kink: split there.
  const double kink = std::atan2(-light.z(), light.y());
  double sum = 0;
  double from = -kPi / 2;
  for (const double to :
       {std::clamp(kink, -kPi / 2, kPi / 2), std::clamp(kink + kPi, -kPi / 2, kPi / 2), kPi / 2}) {
    if (to <= from) continue;
    sum += integrate(lit, from, to, tolerance);
    from = to;
  }
  return sum / kPi;
}

double fibre_maximum_normal(const Vec3& light) {
  return light.z() < 0 ? 0 : across_fibre(light);
}

}  // namespace sateen::brdf
