// SPDX-License-Identifier: MIT
// Fits the fuzz model's approximations to its integrals and prints coefficients and residuals: what
// docs/fuzz.md quotes and src/brdf/fuzz_approximations.h holds.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/brdf/fuzz_approximations.h"
#include "sateen/brdf/fuzz_integrals.h"
#include "sateen/brdf/fuzz_table.h"

namespace {

using namespace sateen;

/// Residuals of the table, and of the slides' ambient product, at directions between its nodes.
struct TableErrors {
  brdf::FitError scattered_down;
  double response_table = 0;   ///< largest ratio to the integral, either way
  double response_slides = 0;  ///< the same of G~ (1 - P_s)
};

TableErrors table_errors(const brdf::FuzzParameters& fuzz) {
  const brdf::FuzzTable table = brdf::make_fuzz_table(fuzz);
  TableErrors errors;
  int count = 0;
  for (int i = 0; i < 14; ++i) {
    const double z = (i + 0.5) / 14;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < 11; ++j, ++count) {
      const double phi = kPi * (j + 0.37) / 11;
      const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
      const double exact = brdf::fuzz_scattered_down(fuzz, w, 1e-5);
      const double difference = table.scattered_down(w).x() - exact;
      errors.scattered_down.rmse += difference * difference;
      errors.scattered_down.largest = std::max(errors.scattered_down.largest, std::abs(difference));
      const double response = brdf::fuzz_uniform_response(fuzz, w, 1e-6);
      const auto ratio = [&](double value) { return std::max(value / response, response / value); };
      const double visibility = brdf::fuzz_visibility_slides(fuzz.density, z);
      errors.response_table = std::max(errors.response_table, ratio(table.response(w) * visibility));
      errors.response_slides = std::max(errors.response_slides, ratio((1 - exact) * visibility));
    }
  }
  errors.scattered_down.rmse = std::sqrt(errors.scattered_down.rmse / count);
  return errors;
}

}  // namespace

int main() {
  const brdf::VisibilityFit g = brdf::fit_visibility();
  fmt::print("G~(d, m) = d (1 + c0 m + c1 m^2) / (d + c2 m + c3 m^3), d in (0, 0.5]\n");
  fmt::print("  c = {{{:.9f}}}\n  rmse {:.4f}, largest {:.4f}\n\n", fmt::join(g.coefficients, ", "),
             g.error.rmse, g.error.largest);
  const brdf::PassingFit q = brdf::fit_passing();
  fmt::print("Q~(d) = 1 + c0 d + c1 d^2, d in [0, 0.5]\n");
  fmt::print("  c = {{{:.9f}}}\n  rmse {:.4f}, largest {:.4f}\n\n", fmt::join(q.coefficients, ", "),
             q.error.rmse, q.error.largest);

  fmt::print("P_s(u), worst over tilts 0, 22.5, 45, 67.5, 90 degrees: rmse / largest\n");
  fmt::print("{:>6} {:>16} {:>16} {:>16}\n", "alpha", "6 terms (slides)", "10 terms", "15 terms");
  for (const double alpha : {0.1, 0.2, 0.35, 0.5, 0.7, 0.95}) {
    fmt::print("{:>6}", alpha);
    for (int degree = 2; degree <= 4; ++degree) {
      brdf::FitError worst;
      for (int i = 0; i < 5; ++i) {
        brdf::FuzzParameters fuzz;
        fuzz.alpha = alpha;
        fuzz.tilt = radians(22.5 * i);
        const brdf::FitError error = brdf::fit_scattered_down(fuzz, degree).error;
        worst.rmse = std::max(worst.rmse, error.rmse);
        worst.largest = std::max(worst.largest, error.largest);
      }
      fmt::print("  {:.4f} / {:.4f}", worst.rmse, worst.largest);
    }
    fmt::print("\n");
  }

  fmt::print(
      "\nTable, worst over the same tilts (density 0.2): P_s rmse / largest; largest ratio to the "
      "uniform-light "
      "response: table, slides' product\n");
  for (const double alpha : {0.1, 0.2, 0.35, 0.5, 0.7, 0.95}) {
    TableErrors worst;
    for (int i = 0; i < 5; ++i) {
      brdf::FuzzParameters fuzz;
      fuzz.alpha = alpha;
      fuzz.tilt = radians(22.5 * i);
      const TableErrors errors = table_errors(fuzz);
      worst.scattered_down.rmse = std::max(worst.scattered_down.rmse, errors.scattered_down.rmse);
      worst.scattered_down.largest = std::max(worst.scattered_down.largest, errors.scattered_down.largest);
      worst.response_table = std::max(worst.response_table, errors.response_table);
      worst.response_slides = std::max(worst.response_slides, errors.response_slides);
    }
    fmt::print("{:>6}  {:.4f} / {:.4f}   {:.3f}   {:.2f}\n", alpha, worst.scattered_down.rmse,
               worst.scattered_down.largest, worst.response_table, worst.response_slides);
  }
  return 0;
}
