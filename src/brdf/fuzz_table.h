// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/hemisphere_table.h"

namespace sateen {

/// What a shader needs of one fuzz besides its formula, tabulated over directions in the fibre's own frame
/// (azimuth 0): far closer to the integrals than the slides' polynomials, and right where their ambient
/// product is not.
struct FuzzTable {
  /// x: P_s(u) of a light u. y: the uniform-light response (fuzz_uniform_response) of a view v over
  /// fuzz_visibility_slides, the correction of the slides' ambient product including its (1 - P_s).
  HemisphereTable scattering;
  /// xyz: mean of the light directions u over p(u, v) g(u, v) for a view v, a vector shorter than 1: where
  /// the fuzz looks, and how narrowly.
  HemisphereTable gaze;
  double passing = 1;         ///< Q
  double scattered_down = 0;  ///< R
};

/// Integrates a table; about a tenth of a second.
FuzzTable make_fuzz_table(const FuzzParameters& fuzz, int size = 33);

}  // namespace sateen
