// SPDX-License-Identifier: MIT
#include "sateen/brdf/fuzz_approximations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

#include "sateen/brdf/fuzz_integrals.h"

namespace sateen::brdf {

namespace {

constexpr double kLargestDensity = 0.5;
/// Of the misfit, summed and minimised. A little above 2 it trades a trace of rmse for a smaller largest
/// error.
constexpr double kPower = 2.5;
constexpr double kVisibilityPower = 2.6;
constexpr double kPassingPower = 3;

/// The monomials of a polynomial in x and y by rising degree: 1, x, y, x^2, x y, y^2, x^3, ...
std::vector<double> monomials(double x, double y, int degree) {
  std::vector<double> values;
  for (int total = 0; total <= degree; ++total) {
    for (int j = 0; j <= total; ++j) values.push_back(std::pow(x, total - j) * std::pow(y, j));
  }
  return values;
}

FitError residuals(const Eigen::VectorXd& difference) {
  return {std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())),
          difference.cwiseAbs().maxCoeff()};
}

/// Levenberg and Marquardt's descent to the least sum of |misfit|^power.
Eigen::VectorXd least_powers(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& misfit,
                             Eigen::VectorXd c, double power) {
  const auto raised = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    return misfit(at).unaryExpr(
        [power](double r) { return std::copysign(std::pow(std::abs(r), power / 2), r); });
  };
  const Eigen::Index count = c.size();
  Eigen::VectorXd difference = raised(c);
  double damping = 1e-2;
  for (int step = 0; step < 500 && damping < 1e12; ++step) {
    Eigen::MatrixXd slope(difference.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::VectorXd nudge = 1e-5 * Eigen::VectorXd::Unit(count, k);
      slope.col(k) = (raised(c + nudge) - raised(c - nudge)) / 2e-5;
    }
    Eigen::MatrixXd normal = slope.transpose() * slope;
    normal.diagonal() *= 1 + damping;
    const Eigen::VectorXd next = c - normal.ldlt().solve(slope.transpose() * difference);
    const Eigen::VectorXd changed = raised(next);
    const double gain = difference.squaredNorm() - changed.squaredNorm();
    if (gain <= 0) {
      damping *= 6;
      continue;
    }
    c = next;
    difference = changed;
    damping /= 4;
    if (gain < 1e-15 * difference.squaredNorm()) break;
  }
  return c;
}

/// The same for a linear fit, by reweighted least squares. Where columns coincide, as x and y do with the
/// fibre along the normal, the rank-revealing solve takes the shortest solution.
Eigen::VectorXd least_powers_linear(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                                    double power) {
  Eigen::VectorXd c = matrix.completeOrthogonalDecomposition().solve(values);
  for (int step = 0; step < 12; ++step) {
    const Eigen::ArrayXd misfit = (matrix * c - values).array().abs();
    const double largest = misfit.maxCoeff();
    if (largest < 1e-12) break;
    const Eigen::VectorXd weight = (misfit / largest + 1e-6).pow((power - 2) / 2).matrix();
    const Eigen::VectorXd next =
        (weight.asDiagonal() * matrix).completeOrthogonalDecomposition().solve(weight.cwiseProduct(values));
    c += (next - c) / (power - 1);
  }
  return c;
}

struct VisibilitySample {
  double density, cosine, value;
};

std::vector<VisibilitySample> visibility_samples() {
  std::vector<VisibilitySample> samples;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 50; ++j) {
      const double density = kLargestDensity * (i + 0.5) / 40;
      const double cosine = (j + 0.5) / 50;
      samples.push_back({density, cosine, fuzz_visibility(density, cosine, 1e-7)});
    }
  }
  return samples;
}

}  // namespace

double ScatteredDownPolynomial::operator()(const Vec3& light, const FuzzParameters& fuzz) const {
  const std::vector<double> values = monomials(light.z(), light.dot(fuzz.fibre()), degree);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += coefficients[i] * values[i];
  return std::clamp(sum, 0.0, 1.0);
}

ScatteredDownPolynomial fit_scattered_down(const FuzzParameters& fuzz, int degree) {
  // Even in solid angle over half the hemisphere; the other half mirrors it about the fibre's plane.
  constexpr int kZ = 16;
  constexpr int kPhi = 16;
  FuzzParameters turned = fuzz;
  turned.azimuth = 0;
  const auto terms = static_cast<Eigen::Index>((degree + 1) * (degree + 2) / 2);
  Eigen::MatrixXd matrix(kZ * kPhi, terms);
  Eigen::VectorXd values(kZ * kPhi);
  for (int i = 0; i < kZ; ++i) {
    const double z = (i + 0.5) / kZ;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < kPhi; ++j) {
      const double phi = kPi * (j + 0.5) / kPhi;
      const Vec3 light(r * std::cos(phi), r * std::sin(phi), z);
      const std::vector<double> row = monomials(z, light.dot(turned.fibre()), degree);
      matrix.row(i * kPhi + j) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), terms);
      values[i * kPhi + j] = fuzz_scattered_down(turned, light, 1e-5);
    }
  }
  const Eigen::VectorXd solution = least_powers_linear(matrix, values, kPower);
  ScatteredDownPolynomial fit;
  fit.degree = degree;
  fit.coefficients.assign(solution.begin(), solution.end());
  fit.error = residuals(matrix * solution - values);
  return fit;
}

double fuzz_visibility_slides(double density, double view_cosine, const std::array<double, 4>& c) {
  const double m = std::max(view_cosine, 0.0);
  if (density <= 0) return 0;
  return density * (1 + m * (c[0] + m * c[1])) / (density + m * (c[2] + m * m * c[3]));
}

double fuzz_visibility_slides(double density, double view_cosine) {
  return fuzz_visibility_slides(density, view_cosine, kVisibilitySlides);
}

double fuzz_passing_albedo_slides(double density) {
  return 1 + density * (kPassingSlides[0] + density * kPassingSlides[1]);
}

VisibilityFit fit_visibility() {
  const std::vector<VisibilitySample> samples = visibility_samples();
  const auto misfit = [&](const Eigen::VectorXd& c) {
    Eigen::VectorXd difference(static_cast<Eigen::Index>(samples.size()));
    for (Eigen::Index i = 0; i < difference.size(); ++i) {
      const VisibilitySample& s = samples[static_cast<std::size_t>(i)];
      difference[i] = fuzz_visibility_slides(s.density, s.cosine, {c[0], c[1], c[2], c[3]}) - s.value;
    }
    return difference;
  };
  const Eigen::VectorXd c = least_powers(misfit, Eigen::Vector4d(-1, 0.5, 0.5, 0), kVisibilityPower);
  return {{c[0], c[1], c[2], c[3]}, residuals(misfit(c))};
}

PassingFit fit_passing() {
  std::array<double, 100> exact{};
  const auto density = [&](std::size_t i) {
    return kLargestDensity * (static_cast<double>(i) + 0.5) / static_cast<double>(exact.size());
  };
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i] = fuzz_passing_albedo(density(i));
  const auto misfit = [&](const Eigen::VectorXd& c) {
    Eigen::VectorXd difference(static_cast<Eigen::Index>(exact.size()));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double d = density(i);
      difference[static_cast<Eigen::Index>(i)] = 1 + d * (c[0] + d * c[1]) - exact[i];
    }
    return difference;
  };
  const Eigen::VectorXd c = least_powers(misfit, Eigen::Vector2d(-1.5, 1), kPassingPower);
  return {{c[0], c[1]}, residuals(misfit(c))};
}

}  // namespace sateen::brdf
