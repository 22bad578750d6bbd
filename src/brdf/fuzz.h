// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::brdf {

// Fuzz (asperity scattering): a thin single-scattering layer of fibres over a base layer, after Patry,
// "Samurai Shading" (2020), which made Koenderink and Pont's "The Secret of Velvety Skin" (2003) anisotropic.
// Directions are unit vectors in the shading frame (tangent x, bitangent y, normal z) and point away from the
// surface; u is the light, v the view. Corrections to the slides are named where they matter.

/// How a fibre scatters: the phase function p(u, v), in 1/sr.
enum class FuzzPhase {
  sggx,  ///< D(h) / (4 sigma(u)) of a fibre-like SGGX. Exactly normalised over v, and *not* reciprocal:
         ///< p(u, v) / p(v, u) = sigma(v) / sigma(u), up to 1 / alpha
  sggx_symmetric,  ///< D(h) / (4 max(sigma(u), sigma(v))): reciprocal, loses up to that ratio and never gains
  schlick,  ///< Schlick's Henyey-Greenstein in the angle between h and the fibre; reciprocal, conservative
};

struct FuzzParameters {
  double density = 0.2;  ///< d = thickness / mean free path; the slides use [0, 0.5]; 0 is no fuzz
  double alpha = 0.5;    ///< spread of the fibres in (0, 1]: the SGGX roughness; 1 scatters evenly
  double k =
      0.75;  ///< Schlick's asymmetry in (-1, 1), used by FuzzPhase::schlick; positive gathers h across fibres
  FuzzPhase phase = FuzzPhase::sggx;
  double tilt = 0;       ///< of the fibre from the normal, radians; a fibre is a line
  double azimuth = 0;    ///< of the fibre's projection, radians counter-clockwise from the tangent
  Vec3 colour{1, 1, 1};  ///< c_f, single-scattering albedo of a fibre, [0, 1]

  Vec3 fibre() const;  ///< unit, in the shading frame: the end that points out of the surface
};

/// alpha and k of equal spread: k = 1 - alpha^2. (The slides print k = -0.1 for alpha = 0.95; with their
/// Schlick formula the sign must be positive.) spread, the artist's parameter of the slides, is alpha^2.
double fuzz_k_of_alpha(double alpha);
double fuzz_alpha_of_k(double k);

/// D_F(h): the SGGX distribution of flake normals around a fibre; 1/sr, integrates to sigma-weighted 1.
double fuzz_fibre_distribution(double alpha, double cosine_to_fibre);
/// sigma_F(u): projected area of those flakes, in [alpha, 1].
double fuzz_projected_area(double alpha, double cosine_to_fibre);

/// r(k) of the slides: 1 / the integral of Schlick's lobe over all v for a light across the fibre (u.t = 0),
/// in closed form. Conservative for k >= 0 only, where light across the fibre scatters most.
double fuzz_schlick_normalisation_printed(double k);
/// The same for a light along the fibre (u.t = 1).
double fuzz_schlick_normalisation_along(double k);
/// What sateen uses: the printed one for k >= 0, the one along the fibre below, so that energy is never
/// created.
double fuzz_schlick_normalisation(double k);

/// The phase function p(u, v), 1/sr, over the whole sphere of directions.
double fuzz_phase(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view);

/// A view drawn for a light with the density p(u, v) of FuzzPhase::sggx, over the whole sphere: the light
/// reflected by a normal of the flakes visible from it (Heitz et al. 2015, section 3.3). `sample` is uniform
/// in [0, 1)^2. The other phase functions may be weighted by their ratio to that one.
Vec3 fuzz_sample_view(const FuzzParameters& fuzz, const Vec3& light, const Vec2& sample);

/// f(u, v) = c p(u, v) (1 - exp(-d (u+v).n / ((u.n)(v.n)))) / ((u+v).n), without the cosine, 1/sr; 0 when a
/// direction is at or below the horizon. (The slides print (u.v)(v.n) under the exponent; Monte Carlo through
/// the slab gives this.)
Vec3 fuzz_brdf(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view);

/// P_p(u) and P_e(v), exp(-d / w.n): the chance to cross the layer without scattering. 0 at and below the
/// horizon.
double fuzz_passing(double density, const Vec3& direction);

/// Attenuation of the base layer's BRDF, [P_p(u) + c (1 - P_p(u)) P_s(u)] P_e(v); `scattered_down` is P_s(u).
Vec3 fuzz_attenuation(const FuzzParameters& fuzz, const Vec3& light, const Vec3& view, double scattered_down);

}  // namespace sateen::brdf
