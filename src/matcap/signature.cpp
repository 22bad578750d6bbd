// SPDX-License-Identifier: MIT
#include "sateen/matcap/signature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sateen::matcap {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kWindows = 40;
constexpr std::size_t kMostSamples = 300;  // in one window: sums of smooth functions need no more

double cubic(double a, double b, double c, double d, double t) {
  return b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// Catmull-Rom lookup of a single-channel picture, clamped to its border.
double sample_cubic(const Image& image, double x, double y) {
  const int x0 = static_cast<int>(std::floor(x - 0.5));
  const int y0 = static_cast<int>(std::floor(y - 0.5));
  const double tx = x - 0.5 - x0;
  const double ty = y - 0.5 - y0;
  std::array<double, 4> rows{};
  for (int j = 0; j < 4; ++j) {
    const int py = std::clamp(y0 - 1 + j, 0, image.height - 1);
    const auto at = [&](int i) -> double {
      return image.at(std::clamp(x0 - 1 + i, 0, image.width - 1), py, 0);
    };
    rows[static_cast<std::size_t>(j)] = cubic(at(0), at(1), at(2), at(3), tx);
  }
  return cubic(rows[0], rows[1], rows[2], rows[3], ty);
}

double density(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2 * kPi);
}

/// Probability of [a, b] under the standard normal distribution, without cancellation in the tails.
double probability(double a, double b) {
  if (a > 0) return 0.5 * (std::erfc(a / std::sqrt(2.0)) - std::erfc(b / std::sqrt(2.0)));
  if (b < 0) return 0.5 * (std::erfc(-b / std::sqrt(2.0)) - std::erfc(-a / std::sqrt(2.0)));
  return 0.5 * (std::erf(b / std::sqrt(2.0)) - std::erf(a / std::sqrt(2.0)));
}

/// Slopes of log variance over log window; steeper ones than this, either way, are no plateau.
constexpr double kPlateau = 0.15;
/// A minimum counts when the variance rises again by this much of itself.
constexpr double kRise = 0.02;

/// Figure 4 on the logarithms, over the longest run of windows without degenerate ones from the first valid
/// window on.
void choose_window(Signature& s) {
  const auto valid = [&](std::size_t i) { return i < s.variance.size() && std::isfinite(s.variance[i]); };
  std::size_t first = 0;
  while (first < s.variance.size() && !(valid(first) && valid(first + 1) && valid(first + 2))) ++first;
  if (first == s.variance.size()) return;
  std::size_t last = first;
  while (valid(last + 1)) ++last;
  std::vector<double> y;
  for (std::size_t i = first; i <= last; ++i) y.push_back(std::log(s.variance[i]));
  const double step = std::log(s.eps[1] / s.eps[0]);
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / step; };

  std::size_t start = 0;
  bool inflected = false;
  // A feature narrower than the window is seen whole already: what follows is its surroundings.
  const bool seen_whole = s.variance[first] < s.eps[first] * s.eps[first] / 9;
  if (!seen_whole && slope(0) > kPlateau && slope(1) > kPlateau) {
    // The initial increase: it ends where the curve, after it has bent down, bends up again.
    bool bent_down = false;
    for (std::size_t i = 1; i + 1 < y.size() && !inflected; ++i) {
      const double bend = slope(i) - slope(i - 1);
      if (bend < 0) bent_down = true;
      if (bent_down && (bend > 0 || slope(i) <= 0)) {
        start = i;
        inflected = true;
      }
    }
    if (!inflected) {
      s.chosen = last;
      s.found = Signature::Case::widest;
      return;
    }
  }
  std::size_t lowest = start;
  for (std::size_t i = start; i < y.size(); ++i) {
    if (y[i] < y[lowest]) lowest = i;
    if (y[i] > y[lowest] + kRise) {
      const bool minimum = lowest > start || !inflected;
      s.chosen = first + lowest;
      s.found = minimum ? Signature::Case::minimum : Signature::Case::inflection;
      return;
    }
  }
  s.chosen = first + (inflected ? lowest : y.size() - 1);
  s.found = inflected && lowest == start ? Signature::Case::inflection : Signature::Case::widest;
}

}  // namespace

MeridianProfile meridian_profile(const Image& component, const Disc& disc, double azimuth) {
  const int half = std::max(8, static_cast<int>(std::ceil(disc.radius * kPi)));
  MeridianProfile profile{kPi / (2.0 * half), {}};
  const Vec2 direction(std::cos(azimuth), std::sin(azimuth));
  // The outermost pixel mixes with the background.
  const double reach = 1 - 1 / disc.radius;
  for (int i = 0; i <= 2 * half; ++i) {
    const double r = std::clamp(std::sin(profile.angle(static_cast<std::size_t>(i))), -reach, reach);
    const Vec2 p = disc_pixel(disc, r * direction);
    profile.values.push_back(sample_cubic(component, p.x(), p.y()));
  }
  return profile;
}

MeridianProfile derivative(const MeridianProfile& profile) {
  MeridianProfile result{profile.step, std::vector<double>(profile.values.size(), 0)};
  // Over the width of a pixel at the middle of the sphere: two samples.
  for (std::size_t i = 1; i + 1 < profile.values.size(); ++i) {
    result.values[i] = (profile.values[i + 1] - profile.values[i - 1]) / (2 * profile.step);
  }
  return result;
}

Moments truncated_moments(const Moments& normal, double a, double b) {
  const double s = std::sqrt(normal.variance);
  const double alpha = (a - normal.mean) / s;
  const double beta = (b - normal.mean) / s;
  const double z = probability(alpha, beta);
  const double shift = (density(alpha) - density(beta)) / z;
  return {normal.mean + s * shift,
          normal.variance * (1 + (alpha * density(alpha) - beta * density(beta)) / z - shift * shift)};
}

std::optional<Moments> untruncated(const Moments& moments, double a, double b) {
  if (!(moments.variance > 0) || moments.variance >= 0.98 * (b - a) * (b - a) / 12) return std::nullopt;
  Moments normal = moments;
  for (int i = 0; i < 60; ++i) {
    const Moments cut = truncated_moments(normal, a, b);
    if (!(cut.variance > 0)) return std::nullopt;
    const double ratio = moments.variance / cut.variance;
    const double shift = moments.mean - cut.mean;
    normal.variance *= ratio;
    normal.mean += shift;
    if (normal.variance > 100 * (b - a) * (b - a)) return std::nullopt;
    if (std::abs(ratio - 1) < 1e-7 && std::abs(shift) < 1e-7 * (b - a)) break;
  }
  return normal;
}

std::optional<double> windowed_variance(const MeridianProfile& profile, double theta, double eps) {
  const double last = static_cast<double>(profile.values.size() - 1);
  const double centre = (theta + kPi / 2) / profile.step;
  const auto first = static_cast<std::size_t>(std::ceil(std::max(0.0, centre - eps / profile.step)));
  const auto end = static_cast<std::size_t>(std::floor(std::min(last, centre + eps / profile.step)));
  if (end < first + 4) return std::nullopt;
  const double inverse = 4.5 / (eps * eps);  // of 2 (eps / 3)^2
  const std::size_t stride = 1 + (end - first) / kMostSamples;
  double sum = 0;
  double sum1 = 0;
  double sum2 = 0;
  for (std::size_t i = first; i <= end; i += stride) {
    const double t = (static_cast<double>(i) - centre) * profile.step;
    const double weight = std::max(profile.values[i], 0.0) * std::exp(-inverse * t * t);
    sum += weight;
    sum1 += weight * t;
    sum2 += weight * t * t;
  }
  if (!(sum > 0)) return std::nullopt;
  const double mean = sum1 / sum;
  // Each sample stands for an interval of one stride.
  const double half = 0.5 * static_cast<double>(stride);
  const double last_used = static_cast<double>(first + (end - first) / stride * stride);
  const double a = (static_cast<double>(first) - centre - half) * profile.step;
  const double b = (last_used - centre + half) * profile.step;
  const auto whole = untruncated({mean, sum2 / sum - mean * mean}, a, b);
  const double window = eps * eps / 9;
  if (!whole || whole->variance >= 0.995 * window) return std::nullopt;
  return window * whole->variance / (window - whole->variance);
}

Signature signature(const MeridianProfile& profile, double theta, double smallest) {
  Signature result;
  const double factor = std::pow(kPi / 2 / smallest, 1.0 / (kWindows - 1));
  for (int i = 0; i < kWindows; ++i) {
    const double eps = smallest * std::pow(factor, i);
    result.eps.push_back(eps);
    result.variance.push_back(windowed_variance(profile, theta, eps).value_or(kNone));
  }
  choose_window(result);
  return result;
}

}  // namespace sateen::matcap
