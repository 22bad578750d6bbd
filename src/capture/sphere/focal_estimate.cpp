// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/focal_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/core/median.h"

namespace sateen::capture {
namespace {

constexpr std::size_t kFewestPoints = 40;
constexpr double kStep = 0.02;  // of the natural log of the focal length
constexpr int kSteps = 110;     // to either side of the prior's middle
// Least noise of a point in pixels: pictures have pixels, outlines have fluff.
constexpr double kLeastNoise = 0.05;
// What blur, JPEG and the shade of the rim may pretend to be an ellipse, pixels of amplitude.
constexpr double kShapeError = 0.1;
// An ordinary lens distorts by some k1 = +-0.03. That stretches the outline like a focal length this much off
// (natural log): 2 k1 (d / f)^2 against (d / f)^2 / 2 for a sphere d pixels from the middle.
constexpr double kDistortion = 0.06;

double tukey(double u) {
  return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

/// Pixels from each point to the outline of the sphere that fits them best, robustly. Seen from the eye the
/// outline is a circular cone: ray . w = 1 for all its rays, w the cone's axis over the cosine of its half
/// angle; so the fit is linear.
std::vector<double> distances(std::span<const Vec2> outline, const Camera& camera) {
  std::vector<Vec3> rays;
  for (const Vec2& p : outline) rays.push_back(camera.ray(p));
  std::vector<double> weights(rays.size(), 1);
  std::vector<double> result(rays.size(), 0);
  for (int round = 0; round < 8; ++round) {
    Mat3 normal = Mat3::Identity() * 1e-12;
    Vec3 right = Vec3::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      normal += weights[i] * rays[i] * rays[i].transpose();
      right += weights[i] * rays[i];
    }
    const Vec3 w = normal.ldlt().solve(right);
    const Vec3 axis = w.normalized();
    const double tangent = std::sqrt(std::max(1e-12, w.squaredNorm() - 1));
    std::vector<double> sizes;
    std::vector<double> scales;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      // How many pixels a radian away from the axis is here.
      constexpr double kSmall = 1e-4;
      const Vec3 outward = (rays[i] * axis.dot(rays[i]) - axis).normalized();
      const double scale = (camera.project(rays[i] + kSmall * outward) - outline[i]).norm() / kSmall;
      scales.push_back(scale / tangent);
      result[i] = (1 - rays[i].dot(w)) * scales.back();
      sizes.push_back(std::abs(result[i]));
    }
    const double wide = 5 * std::max(kLeastNoise, 1.48 * median(sizes));
    for (std::size_t i = 0; i < rays.size(); ++i)
      weights[i] = tukey(result[i] / wide) * scales[i] * scales[i];
  }
  return result;
}

/// How many neighbours in a row say the same, from the autocorrelation of the distances.
double correlation_length(const std::vector<double>& values, double limit) {
  const std::size_t n = values.size();
  const auto bounded = [&](std::size_t i) { return std::clamp(values[i % n], -limit, limit); };
  const auto product = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += bounded(i) * bounded(i + lag);
    return sum;
  };
  const double whole = std::max(1e-12, product(0));
  double length = 1;
  for (std::size_t lag = 1; lag < n / 4; ++lag) {
    const double share = product(lag) / whole;
    if (share < 0.1) break;
    length += 2 * share;
  }
  return length;
}

double robust_sum(const std::vector<double>& values, double noise) {
  double sum = 0;
  for (const double v : values) sum += std::min(9.0, v * v / (noise * noise));
  return sum;
}

}  // namespace

FocalEstimate estimate_focal(std::span<const Vec2> outline, const Camera& assumed) {
  const double middle = assumed.focal.mean();
  FocalEstimate estimate{middle, middle * std::exp(-1.96 * kFocalPrior),
                         middle * std::exp(1.96 * kFocalPrior), false};
  if (outline.size() < kFewestPoints) return estimate;
  std::vector<double> logs;  // relative to the middle
  std::vector<std::vector<double>> fits;
  for (int i = -kSteps; i <= kSteps; ++i) {
    logs.push_back(i * kStep);
    Camera camera = assumed;
    camera.focal *= std::exp(logs.back());
    fits.push_back(distances(outline, camera));
  }
  const auto spread = [](const std::vector<double>& values) {
    std::vector<double> sizes;
    for (const double v : values) sizes.push_back(std::abs(v));
    return 1.48 * median(std::move(sizes));
  };
  const auto& best = *std::ranges::min_element(fits, {}, spread);
  const double noise = std::max(kLeastNoise, spread(best));
  // An ellipse of amplitude a is told from a circle as a sine of that amplitude in the points' noise.
  const double length = correlation_length(best, 3 * noise);
  const double random = 2 * noise * noise * length / static_cast<double>(outline.size());
  const double likeness = length * (random + kShapeError * kShapeError) / random;
  std::vector<double> probability;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const double prior = logs[i] / kFocalPrior;
    probability.push_back(-0.5 * (robust_sum(fits[i], noise) / likeness + prior * prior));
  }
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(probability) - probability.begin());
  const double highest = probability[peak];
  double at = logs[peak];
  if (peak > 0 && peak + 1 < logs.size()) {
    const double left = probability[peak - 1] - highest;
    const double right = probability[peak + 1] - highest;
    if (left + right < 0) at += 0.5 * kStep * (left - right) / (left + right);
  }
  double sum = 0;
  double square = 0;
  double total = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double p = std::exp(probability[i] - highest);
    total += p;
    sum += p * logs[i];
    square += p * logs[i] * logs[i];
  }
  const double mean = sum / total;
  const double deviation = std::sqrt(std::max(0.0, square / total - mean * mean) + kDistortion * kDistortion);
  estimate.informed = deviation < 0.7 * kFocalPrior;
  estimate.focal = middle * std::exp(at);
  // Around the mean: a one-sided tail reaches further than the peak shows.
  estimate.low = std::min(estimate.focal, middle * std::exp(mean - 1.96 * deviation));
  estimate.high = std::max(estimate.focal, middle * std::exp(mean + 1.96 * deviation));
  return estimate;
}

LensEffect lens_effect(double radius, double focal, double real) {
  // The disc of the table, on which the sine of the angle between normal and view ray is the radius.
  const auto half = [&](double f) { return std::atan(radius / f); };
  const auto normal = [](double h) {
    return std::asin(std::sin(std::atan(0.5 * std::tan(h))) / std::sin(h));
  };
  return {degrees(std::abs(normal(half(real)) - normal(half(focal)))),
          degrees(std::abs(half(real) - half(focal)) / 2)};
}

}  // namespace sateen::capture
