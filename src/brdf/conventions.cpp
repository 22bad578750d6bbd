// SPDX-License-Identifier: MIT
#include "sateen/brdf/conventions.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/core/direction.h"

namespace sateen::brdf {

namespace {

double unit(double v) {
  return std::clamp(v, 0.0, 1.0);
}

/// The alpha of a perceptual roughness.
double alpha_of(double roughness) {
  return std::max(unit(roughness) * unit(roughness), kMinimumAlpha);
}

/// The same surface with the larger alpha along the axis, alphas in range.
AnisotropicRoughness ordered(AnisotropicRoughness roughness) {
  roughness.alpha_t = std::clamp(roughness.alpha_t, kMinimumAlpha, 1.0);
  roughness.alpha_b = std::clamp(roughness.alpha_b, kMinimumAlpha, 1.0);
  if (roughness.alpha_t < roughness.alpha_b) {
    std::swap(roughness.alpha_t, roughness.alpha_b);
    roughness.azimuth += kPi / 2;
  }
  roughness.azimuth = wrap(roughness.azimuth, kPi);
  return roughness;
}

AnisotropicRoughness of_aspect(double roughness, double aspect, double rotation) {
  const double alpha = alpha_of(roughness);
  return {std::min(alpha / aspect, 1.0), std::max(alpha * aspect, kMinimumAlpha), rotation};
}

/// x in [low, high] with f(x) = value, f rising.
double invert(const std::function<double(double)>& f, double value, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) < value ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Mean squared cosine between a fibre and its flake normals, closed form; 1/3 for alpha = 1.
double flake_spread(double alpha) {
  const double a2 = alpha * alpha;
  const double b = 1 - a2;
  if (b < 1e-6) return 1.0 / 3;
  const double angle = std::atan(std::sqrt(b) / alpha) / (alpha * std::sqrt(b));
  return (angle - 1) / b * a2 / (1 + angle);
}

double charlie_spread(double roughness) {
  return 1 / (3 + 1 / (roughness * roughness));
}

constexpr double kLowestSheenRoughness = 0.01;

}  // namespace

AnisotropicRoughness from_uv(const UvRoughness& uv) {
  return {alpha_of(uv.along), alpha_of(uv.across), uv.rotation};
}

UvRoughness to_uv(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  return {std::sqrt(r.alpha_t), std::sqrt(r.alpha_b), r.azimuth};
}

AnisotropicRoughness from_gltf(const AnisotropyParameters& gltf) {
  const double alpha = alpha_of(gltf.roughness);
  const double strength = unit(gltf.anisotropy);
  return {alpha + (1 - alpha) * strength * strength, alpha, gltf.rotation};
}

AnisotropyParameters to_gltf(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  const double strength =
      r.alpha_b < 1 ? std::sqrt(std::max(0.0, (r.alpha_t - r.alpha_b) / (1 - r.alpha_b))) : 0;
  return {std::sqrt(r.alpha_b), strength, r.azimuth};
}

AnisotropicRoughness from_materialx(const AnisotropyParameters& materialx) {
  const double aspect = std::sqrt(1 - std::clamp(materialx.anisotropy, 0.0, 0.98));
  return of_aspect(materialx.roughness, aspect, materialx.rotation);
}

AnisotropyParameters to_materialx(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  return {std::pow(r.alpha_t * r.alpha_b, 0.25), std::min(1 - r.alpha_b / r.alpha_t, 0.98), r.azimuth};
}

AnisotropicRoughness from_blender(const AnisotropyParameters& blender) {
  const double aspect = std::sqrt(1 - 0.9 * unit(blender.anisotropy));
  return of_aspect(blender.roughness, aspect, blender.rotation);
}

AnisotropyParameters to_blender(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  return {std::pow(r.alpha_t * r.alpha_b, 0.25), std::min((1 - r.alpha_b / r.alpha_t) / 0.9, 1.0), r.azimuth};
}

AnisotropicRoughness from_filament(const AnisotropyParameters& filament) {
  const double alpha = alpha_of(filament.roughness);
  const double strength = std::clamp(filament.anisotropy, -1.0, 1.0);
  const auto side = [&](double sign) {
    return std::clamp(alpha * (1 + sign * strength), kMinimumAlpha, 1.0);
  };
  return {side(1), side(-1), filament.rotation};
}

AnisotropyParameters to_filament(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  const double sum = r.alpha_t + r.alpha_b;
  return {std::sqrt(sum / 2), (r.alpha_t - r.alpha_b) / sum, r.azimuth};
}

AnisotropicRoughness from_substance(const AnisotropyParameters& substance) {
  const double alpha = alpha_of(substance.roughness);
  const double kept = std::max(1 - unit(substance.anisotropy), alpha);  // alpha across is at most 1
  return {alpha, alpha / kept, -substance.rotation};
}

AnisotropyParameters to_substance(const AnisotropicRoughness& roughness) {
  const AnisotropicRoughness r = ordered(roughness);
  return {std::sqrt(r.alpha_b), 1 - r.alpha_b / r.alpha_t, wrap(kPi / 2 - r.azimuth, kPi)};
}

FuzzParameters from_sheen(const SheenParameters& sheen) {
  FuzzParameters fuzz;
  const double strength = std::min(sheen.colour.maxCoeff(), 1.0);
  fuzz.colour = strength > 0 ? Vec3(sheen.colour / sheen.colour.maxCoeff()) : Vec3::Ones();
  fuzz.density =
      strength > 0 ? invert([](double d) { return 1 - fuzz_passing_albedo(d); }, strength / 2, 0, 1) : 0;
  const double spread = charlie_spread(std::clamp(sheen.roughness, kLowestSheenRoughness, 1.0));
  fuzz.alpha = invert(flake_spread, spread, 1e-3, 1);
  fuzz.k = fuzz_k_of_alpha(fuzz.alpha);
  return fuzz;
}

SheenParameters to_sheen(const FuzzParameters& fuzz) {
  const double strength = std::min(2 * (1 - fuzz_passing_albedo(fuzz.density)), 1.0);
  const double roughness = invert(charlie_spread, flake_spread(fuzz.alpha), kLowestSheenRoughness, 1);
  return {fuzz.colour * strength, roughness};
}

}  // namespace sateen::brdf
