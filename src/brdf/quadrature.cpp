// SPDX-License-Identifier: MIT
#include "sateen/brdf/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "sateen/core/direction.h"

namespace sateen::brdf {

namespace {

// Gauss-Kronrod (7, 15) on [-1, 1]; the odd entries are the Gauss nodes.
constexpr std::array<double, 8> kNodes = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrod = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGauss = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

double integrate_piece(const std::function<double(double)>& f, double a, double b, double tolerance,
                       int depth) {
  const double centre = (a + b) / 2;
  const double half = (b - a) / 2;
  const double middle = f(centre);
  double kronrod = kKronrod[7] * middle;
  double gauss = kGauss[3] * middle;
  for (std::size_t i = 0; i < 7; ++i) {
    const double pair = f(centre - half * kNodes[i]) + f(centre + half * kNodes[i]);
    kronrod += kKronrod[i] * pair;
    if (i % 2 == 1) gauss += kGauss[i / 2] * pair;
  }
  if (std::abs(kronrod - gauss) * half <= tolerance || depth == 0) return kronrod * half;
  return integrate_piece(f, a, centre, tolerance / 2, depth - 1) +
         integrate_piece(f, centre, b, tolerance / 2, depth - 1);
}

GaussRule make_gauss_rule(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    // Newton's method on the Legendre polynomial from the usual cosine guess.
    double x = std::cos(kPi * (i + 0.75) / (n + 0.5));
    double derivative = 1;
    for (int step = 0; step < 100; ++step) {
      double p0 = 1;
      double p1 = x;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      derivative = n * (x * p1 - p0) / (x * x - 1);
      const double change = p1 / derivative;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    rule.nodes.push_back((1 - x) / 2);
    rule.weights.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
  return rule;
}

/// Polar coordinates about an axis, restricted to the upper hemisphere.
struct ConeCoordinates {
  Vec3 axis;
  Vec3 across;  ///< unit, orthogonal to the axis, in the plane of axis and normal, with z >= 0
  Vec3 beside;
  double tilt;  ///< angle of the axis from the normal
  std::vector<double> breaks;

  ConeCoordinates(const Vec3& direction, std::span<const double> cones) : axis(direction) {
    tilt = std::acos(std::clamp(axis.z(), -1.0, 1.0));
    frame_around(axis, across, beside);
    const Vec3 projected = Vec3::UnitZ() - axis * axis.z();
    if (projected.norm() > 1e-9) {
      across = projected.normalized();
      beside = axis.cross(across);
    }
    breaks = {0, kPi, std::abs(kPi / 2 - tilt), kPi - std::abs(kPi / 2 - tilt)};
    for (const double cone : cones) breaks.push_back(std::clamp(cone, 0.0, kPi));
    std::ranges::sort(breaks);
  }

  /// Half the range of azimuths from `across` that lies above the horizon on the cone `polar`; 0 where none
  /// does.
  double half_range(double polar) const {
    const double along = std::cos(polar) * std::cos(tilt);
    const double swing = std::sin(polar) * std::sin(tilt);
    if (along >= swing) return kPi;
    if (along <= -swing) return 0;
    return std::acos(-along / swing);
  }

  Vec3 direction(double polar, double azimuth) const {
    return std::cos(polar) * axis +
           std::sin(polar) * (std::cos(azimuth) * across + std::sin(azimuth) * beside);
  }
};

/// Smooth step that gathers nodes at both ends, where ranges open like a square root and lobes peak.
double ease(double s) {
  return s * s * s * (10 + s * (6 * s - 15));
}
double ease_slope(double s) {
  return 30 * s * s * (1 - s) * (1 - s);
}

}  // namespace

double integrate(const std::function<double(double)>& f, double a, double b, double tolerance,
                 int max_depth) {
  return integrate_piece(f, a, b, tolerance, max_depth);
}

const GaussRule& gauss_rule(int n) {
  static std::mutex mutex;
  static std::map<int, GaussRule> rules;
  const std::lock_guard lock(mutex);
  const auto found = rules.find(n);
  return found != rules.end() ? found->second : rules.emplace(n, make_gauss_rule(n)).first->second;
}

double integrate_hemisphere(const std::function<double(const Vec3&)>& f, const Vec3& axis,
                            std::span<const double> cones, double tolerance) {
  const ConeCoordinates coordinates(axis, cones);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < coordinates.breaks.size(); ++i) {
    const double from = coordinates.breaks[i];
    const double length = coordinates.breaks[i + 1] - from;
    if (length < 1e-12) continue;
    sum += integrate(
        [&](double s) {
          const double polar = from + length * ease(s);
          const double range = coordinates.half_range(polar);
          const double scale = length * ease_slope(s) * std::sin(polar);
          if (range == 0 || scale == 0) return 0.0;
          const auto ring = [&](double azimuth) { return f(coordinates.direction(polar, azimuth)); };
          const double inner = tolerance / 8;
          return scale * (integrate(ring, -range, 0, inner, 12) + integrate(ring, 0, range, inner, 12));
        },
        0, 1, tolerance / static_cast<double>(coordinates.breaks.size()), 12);
  }
  return sum;
}

std::vector<SphereNode> hemisphere_nodes(const Vec3& axis, std::span<const double> cones, int order) {
  const ConeCoordinates coordinates(axis, cones);
  const GaussRule& rule = gauss_rule(order);
  std::vector<SphereNode> nodes;
  nodes.reserve((coordinates.breaks.size() - 1) * rule.nodes.size() * rule.nodes.size());
  for (std::size_t i = 0; i + 1 < coordinates.breaks.size(); ++i) {
    const double from = coordinates.breaks[i];
    const double length = coordinates.breaks[i + 1] - from;
    if (length < 1e-12) continue;
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double s = rule.nodes[j];
      const double polar = from + length * ease(s);
      const double range = coordinates.half_range(polar);
      const double scale = rule.weights[j] * length * ease_slope(s) * std::sin(polar);
      if (range == 0 || scale == 0) continue;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        nodes.push_back({coordinates.direction(polar, range * (2 * rule.nodes[k] - 1)),
                         scale * 2 * range * rule.weights[k]});
      }
    }
  }
  return nodes;
}

}  // namespace sateen::brdf
