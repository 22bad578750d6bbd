// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_integrals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/brdf/quadrature.h"

namespace sateen::brdf {

namespace {

/// Cones about the fibre on which the phase function peaks or starts to fall for one fixed direction: where
/// the half vector is across the fibre, and a few spreads beside it.
std::array<double, 3> lobe_cones(const FuzzParameters& fuzz, const Vec3& fixed) {
  const double peak = kPi - std::acos(std::clamp(fixed.dot(fuzz.fibre()), -1.0, 1.0));
  const double width = fuzz.phase == FuzzPhase::schlick ? std::sqrt(1 - std::abs(fuzz.k)) : fuzz.alpha;
  return {peak, peak - 3 * width, peak + 3 * width};
}

}  // namespace

double fuzz_scattered_down(const FuzzParameters& fuzz, const Vec3& light, double tolerance) {
  const auto cones = lobe_cones(fuzz, light);
  return 1 - integrate_hemisphere([&](const Vec3& view) { return fuzz_phase(fuzz, light, view); },
                                  fuzz.fibre(), cones, tolerance);
}

double fuzz_visibility(double density, double view_cosine, double tolerance) {
  if (density <= 0) return 0;
  if (view_cosine <= 0) return 1;
  const auto g = [&](double x) {
    if (x <= 0) return 0.0;
    return -std::expm1(-density * (x + view_cosine) / (x * view_cosine)) * x / (x + view_cosine);
  };
  return integrate(g, 0, std::min(1.0, density), tolerance / 2) +
         integrate(g, std::min(1.0, density), 1, tolerance / 2);
}

double exponential_integral_3(double x) {
  if (x <= 0) return 0.5;
  // E_3(x) = integral over [0, 1] of t exp(-x / t); for large x the integrand lives near t = 1.
  const auto f = [&](double t) { return t > 0 ? t * std::exp(-x / t) : 0; };
  const double split = 1 / (1 + x);
  return integrate(f, 0, split, 1e-12) + integrate(f, split, 1, 1e-12);
}

double fuzz_passing_albedo(double density) {
  return 2 * exponential_integral_3(density);
}

double fuzz_scattered_down_albedo(const FuzzParameters& fuzz, double tolerance) {
  // P_s is smooth in u and even about the fibre's plane, and R does not depend on the azimuth: a Gauss
  // product rule over half the hemisphere is enough.
  FuzzParameters turned = fuzz;
  turned.azimuth = 0;
  const GaussRule& rule = gauss_rule(16);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double cosine = std::sqrt(rule.nodes[i]);  // du (u.n) = d(cosine^2) dphi / 2
    const double sine = std::sqrt(1 - rule.nodes[i]);
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = kPi * rule.nodes[j];
      const Vec3 light(sine * std::cos(phi), sine * std::sin(phi), cosine);
      sum += rule.weights[i] * rule.weights[j] * fuzz_scattered_down(turned, light, tolerance);
    }
  }
  return sum;
}

double fuzz_uniform_response(const FuzzParameters& fuzz, const Vec3& view, double tolerance) {
  if (view.z() <= 0) return 0;
  FuzzParameters white = fuzz;
  white.colour = Vec3::Ones();
  const auto cones = lobe_cones(fuzz, view);
  return integrate_hemisphere(
      [&](const Vec3& light) { return fuzz_brdf(white, light, view).x() * std::max(0.0, light.z()); },
      fuzz.fibre(), cones, tolerance);
}

double fuzz_albedo(const FuzzParameters& fuzz, const Vec3& light, double tolerance) {
  if (light.z() <= 0) return 0;
  FuzzParameters white = fuzz;
  white.colour = Vec3::Ones();
  const auto cones = lobe_cones(fuzz, light);
  return integrate_hemisphere(
      [&](const Vec3& view) { return fuzz_brdf(white, light, view).x() * std::max(0.0, view.z()); },
      fuzz.fibre(), cones, tolerance);
}

}  // namespace sateen::brdf
