// SPDX-License-Identifier: MIT
#include "sateen/brdf/research/simple_fuzz.h"

#include <algorithm>
#include <cmath>

#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/fuzz_approximations.h"

namespace sateen::brdf {
namespace {

constexpr double kDensity = 0.5;
constexpr double kAlpha = 0.95;
constexpr double kColor = 5;  // times the Lambert colour

/// Wrapped lighting (McAuley 2013) with n = 2, w = 0.2, in place of u.n.
double wrapped_cosine(double cosine) {
  constexpr double kWrap = 0.2;
  const double x = std::max(cosine + kWrap, 0.0) / (1 + kWrap);
  return 3 / (2 * (1 + kWrap)) * x * x;
}

}  // namespace

Vec3 simple_fuzz_lit(const Vec3& color, const Vec3& light, const Vec3& view) {
  FuzzParameters fuzz;
  fuzz.density = kDensity;
  fuzz.alpha = kAlpha;
  const double x = wrapped_cosine(light.z());
  if (x <= 0) return Vec3::Zero();
  const double sum = x + view.z();
  const double scattered = -std::expm1(-fuzz.density * sum / (x * view.z()));
  return color * (kColor * fuzz_phase(fuzz, light, view) * scattered / sum * x);
}

Vec3 simple_fuzz_surroundings(const Vec3& color, const Vec3& mean, const Vec3& view) {
  // The slides' ambient product for the fixed parameters; even scattering sends half down.
  return color.cwiseProduct(mean) * (kColor * fuzz_visibility_slides(kDensity, view.z()) * 0.5);
}

}  // namespace sateen::brdf
