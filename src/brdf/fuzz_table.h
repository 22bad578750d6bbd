// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "sateen/brdf/fibre_table.h"
#include "sateen/brdf/fuzz.h"

namespace sateen::brdf {

/// What a shader needs of one fuzz besides its formula, tabulated over directions in the fibre's own frame
/// (azimuth 0): far closer to the integrals than the slides' polynomials, and right where their ambient
/// product is not.
struct FuzzTable {
  FibreTable scattered_down;  ///< x: P_s(u) of a light u
  /// Of a view v. xyz: mean of the light directions u over p(u, v) g(u, v), a vector shorter than 1, where
  /// the fuzz looks, and how narrowly; its y is over v.y, which makes it even about the fibre's plane. w: the
  /// uniform-light response (fuzz_uniform_response) over fuzz_visibility_slides, the correction of the
  /// slides' ambient product including its (1 - P_s).
  FibreTable ambient;

  double passing = 1;              ///< Q
  double scattered_down_mean = 0;  ///< R
  /// How light of the surroundings reaches a diffuse base, in bands of spherical harmonics: (1/pi) times the
  /// integrals of P_p(u) (u.n) P_l(u.n) and of (1 - P_p(u)) P_s(u) (u.n) P_l(u.n), P_l the Legendre
  /// polynomials, l = 0, 1, 2. Without fuzz the first are 1, 2/3, 1/4. The slides' Q and R (1 - Q) stand for
  /// l = 0.
  std::array<double, 3> passing_bands{1, 2.0 / 3, 0.25};
  std::array<double, 3> scattered_bands{0, 0, 0};

  double response(const Vec3& view) const { return ambient(view).w(); }
};

/// Integrates a table; about 0.07 s of one core, and as much again in the allocator on a busy machine.
FuzzTable make_fuzz_table(const FuzzParameters& fuzz);

}  // namespace sateen::brdf
