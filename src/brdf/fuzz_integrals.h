// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/fuzz.h"

namespace sateen::brdf {

// The fuzz model's integrals as they are defined (Samurai Shading, shadowing and ambient slides), by adaptive
// quadrature: the reference that fits and tables are held to. Directions as in fuzz.h; `tolerance` is
// absolute.

/// P_s(u) = 1 - the integral of p(u, v) over the upper hemisphere of v: the chance that light from u, once
/// scattered, goes down to the base layer. For phase functions that lose energy the loss counts as going
/// down, as the slides define it.
double fuzz_scattered_down(const FuzzParameters& fuzz, const Vec3& light, double tolerance = 1e-7);

/// G(d, v) = (1/2pi) times the integral over lights u of g(u, v) = (1 - exp(-d (u+v).n/((u.n)(v.n))))
/// (u.n)/((u+v).n). Depends on v.n alone; 1 at grazing, in [0, 1].
double fuzz_visibility(double density, double view_cosine, double tolerance = 1e-9);

/// Q(d) = (1/pi) times the integral of P_p(u) (u.n), exactly 2 E_3(d): the share of uniform light that
/// passes.
double fuzz_passing_albedo(double density);

/// R = (1/pi) times the integral of P_s(u) (u.n) over the hemisphere (the slides leave out 1/pi): the share
/// of evenly scattered light that goes down. Depends on tilt and spread only.
double fuzz_scattered_down_albedo(const FuzzParameters& fuzz, double tolerance = 1e-5);

/// Radiance towards v in uniform light of radiance 1, for white fibres: the integral of p(u, v) g(u, v) over
/// u. What the slides' product G (1 - P_s) stands for; that product is up to 3.4 times too bright for
/// gathered fibres.
double fuzz_uniform_response(const FuzzParameters& fuzz, const Vec3& view, double tolerance = 1e-7);

/// The share of light from u that the layer sends up, for white fibres: the integral of f(u, v) (v.n) over v,
/// at most 1.
double fuzz_albedo(const FuzzParameters& fuzz, const Vec3& light, double tolerance = 1e-7);

/// E_3(x), the exponential integral, x >= 0.
double exponential_integral_3(double x);

}  // namespace sateen::brdf
