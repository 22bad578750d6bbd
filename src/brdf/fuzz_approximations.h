// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sateen/brdf/fuzz.h"

namespace sateen::brdf {

// Cheap stand-ins for the integrals of fuzz_integrals.h, as a shader needs them. The forms are the slides'
// (Samurai Shading), the coefficients ours: `bench_fuzz_fit` integrates, fits and prints them with their
// residuals.

/// Residuals of a fit over the samples it was made from.
struct FitError {
  double rmse = 0;
  double largest = 0;
};

/// P_s(u) as a polynomial in x = u.n and y = u.t (t: the fibre): every x^i y^j with i + j <= degree. Degree 2
/// is the slides' form, in their order c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2; higher degrees follow the
/// same pattern.
struct ScatteredDownPolynomial {
  static constexpr int kSlidesDegree = 2;
  int degree = kSlidesDegree;
  std::vector<double> coefficients;
  FitError error;

  double operator()(const Vec3& light, const FuzzParameters& fuzz) const;
};

/// Fit to fuzz_scattered_down on an even grid of the hemisphere: least sum of |misfit|^2.5, whose rmse is
/// within 1 % of least squares and whose largest error is smaller. The coefficients depend on spread, tilt
/// and phase function; a few milliseconds.
ScatteredDownPolynomial fit_scattered_down(const FuzzParameters& fuzz, int degree);

/// G~(d, v) of the slides, d (1 + c0 m + c1 m^2) / (d + c2 m + c3 m^3) with m = v.n, for d in [0, 0.5].
inline constexpr std::array<double, 4> kVisibilitySlides = {-1.048755973, 0.573646848, 0.662396866,
                                                            -0.131619429};
double fuzz_visibility_slides(double density, double view_cosine);
double fuzz_visibility_slides(double density, double view_cosine, const std::array<double, 4>& coefficients);

/// Q~(d) of the slides, 1 + c0 d + c1 d^2, for d in [0, 0.5].
inline constexpr std::array<double, 2> kPassingSlides = {-1.732735170, 1.275906833};
double fuzz_passing_albedo_slides(double density);

/// The fits behind the constants above, made again. Both minimise a sum of powers a little above 2 of the
/// misfit, which costs hardly any rmse and lowers the largest error.
struct VisibilityFit {
  std::array<double, 4> coefficients;
  FitError error;
};
VisibilityFit fit_visibility();
struct PassingFit {
  std::array<double, 2> coefficients;
  FitError error;
};
PassingFit fit_passing();

}  // namespace sateen::brdf
