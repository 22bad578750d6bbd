// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"

namespace sateen::brdf {

namespace {

/// Schlick's lobe before normalisation, as a function of the sine between h and the fibre.
double schlick_lobe(double k, double sine) {
  const double q = 1 - k * sine;
  return (1 - k * k) / (4 * kPi * q * q);
}

}  // namespace

Vec3 FuzzParameters::fibre() const {
  const Vec3 end(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
  return end.z() >= 0 ? end : Vec3(-end);
}

double fuzz_k_of_alpha(double alpha) {
  return 1 - alpha * alpha;
}

double fuzz_alpha_of_k(double k) {
  return std::sqrt(std::clamp(1 - k, 0.0, 1.0));
}

double fuzz_fibre_distribution(double alpha, double cosine) {
  const double q = cosine * cosine * (1 - alpha * alpha) + alpha * alpha;
  return alpha * alpha * alpha / (kPi * q * q);
}

double fuzz_projected_area(double alpha, double cosine) {
  return std::sqrt(std::max(0.0, 1 - cosine * cosine * (1 - alpha * alpha)));
}

double fuzz_schlick_normalisation_printed(double k) {
  // With u across the fibre, dv = 4 (u.h) dh turns the integral over v into
  // (2 (1 - k^2) / pi) times the integral of sin^2 / (1 - k sin)^2 over [0, pi].
  double integral;
  if (std::abs(k) < 1e-2) {
    // The closed form cancels: its series, from the moments of sin^(2 + n) and 1/(1 - x)^2 = sum (n + 1) x^n.
    const double moments[] = {kPi / 2,      4.0 / 3,   3 * kPi / 8,   16.0 / 15,
                              5 * kPi / 16, 32.0 / 35, 35 * kPi / 128};
    integral = 0;
    double power = 1;
    for (int n = 0; n < 7; ++n) {
      integral += (n + 1) * power * moments[n];
      power *= k;
    }
  } else {
    const double root = std::sqrt(1 - k * k);
    const double angle = kPi + 2 * std::asin(k);
    const double first = angle / root;                                           // of 1 / (1 - k sin)
    const double second = angle / (root * root * root) + 2 * k / (root * root);  // of 1 / (1 - k sin)^2
    integral = (second - 2 * first + kPi) / (k * k);
  }
  return kPi / (2 * (1 - k * k) * integral);
}

double fuzz_schlick_normalisation_along(double k) {
  // With u along the fibre the integral is 2 (1 - k^2) times that of s / (1 - k s)^2 over [0, 1].
  double integral;
  if (std::abs(k) < 1e-2) {
    integral = 0;
    double power = 1;
    for (int n = 0; n < 8; ++n) {
      integral += power * (n + 1) / (n + 2);
      power *= k;
    }
  } else {
    integral = (std::log1p(-k) + k / (1 - k)) / (k * k);
  }
  return 1 / (2 * (1 - k * k) * integral);
}

double fuzz_schlick_normalisation(double k) {
  return k >= 0 ? fuzz_schlick_normalisation_printed(k) : fuzz_schlick_normalisation_along(k);
}

double fuzz_phase(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view) {
  const Vec3 fibre = fuzz.fibre();
  const Vec3 sum = light + view;
  const double length = sum.norm();
  // Straight through: the half vector is any across the light; take the one across the fibre too, where the
  // lobe peaks.
  const double cosine = length > 1e-12 ? std::clamp(sum.dot(fibre) / length, -1.0, 1.0) : 0;
  switch (fuzz.phase) {
    case FuzzPhase::schlick:
      return fuzz_schlick_normalisation(fuzz.k) * schlick_lobe(fuzz.k, std::sqrt(1 - cosine * cosine));
    case FuzzPhase::sggx:
      return fuzz_fibre_distribution(fuzz.alpha, cosine) /
             (4 * fuzz_projected_area(fuzz.alpha, light.dot(fibre)));
    case FuzzPhase::sggx_symmetric:
      break;
  }
  const double area = std::max(fuzz_projected_area(fuzz.alpha, light.dot(fibre)),
                               fuzz_projected_area(fuzz.alpha, view.dot(fibre)));
  return fuzz_fibre_distribution(fuzz.alpha, cosine) / (4 * area);
}

Vec3 fuzz_sample_view(const FuzzParameters& fuzz, const Vec3& light, const Vec2& sample) {
  // The flakes are an ellipsoid with half axes alpha across the fibre and 1 along it, seen from the light:
  // points even over its outline are points even over a disc where the ellipsoid is a sphere.
  const Vec3 fibre = fuzz.fibre();
  Vec3 first;
  Vec3 second;
  const double along = light.dot(fibre);
  const Vec3 towards = (light + (fuzz.alpha - 1) * along * fibre).normalized();
  frame_around(towards, first, second);
  const double radius = std::sqrt(sample.x());
  const double angle = 2 * kPi * sample.y();
  const Vec3 point = radius * (std::cos(angle) * first + std::sin(angle) * second) +
                     std::sqrt(std::max(0.0, 1 - sample.x())) * towards;
  const Vec3 normal = (point + (fuzz.alpha - 1) * point.dot(fibre) * fibre).normalized();
  return (2 * light.dot(normal) * normal - light).normalized();
}

Vec3 fuzz_brdf(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view) {
  if (light.z() <= 0 || view.z() <= 0) return Vec3::Zero();
  const double sum = light.z() + view.z();
  const double scattered = -std::expm1(-fuzz.density * sum / (light.z() * view.z()));
  return fuzz.colour * (fuzz_phase(fuzz, light, view) * scattered / sum);
}

double fuzz_passing(double density, const Vec3& direction) {
  return direction.z() > 0 ? std::exp(-density / direction.z()) : 0;
}

Vec3 fuzz_attenuation(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view,
                      double scattered_down) {
  const double passing = fuzz_passing(fuzz.density, light);
  return (Vec3::Constant(passing) + fuzz.colour * ((1 - passing) * scattered_down)) *
         fuzz_passing(fuzz.density, view);
}

}  // namespace sateen::brdf
