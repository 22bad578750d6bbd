// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::brdf {

// Diffuse light on a surface of fine parallel fibres, after Hast, Wesslen and Seipel, "Improved Diffuse
// Anisotropic Shading": the light of all fibre normals n' in the plane across the fibre is summed, not only
// that of the brightest. Directions are unit vectors in the shading frame (fibre x, bitangent y, normal z)
// that point away from the surface.

/// Phi of the paper's (8): (1/pi) times the integral over the fibre's upper half of max(0, n'.l), in closed
/// form.
///
/// The printed (10) holds only for l.t > 0; this is the form that holds everywhere,
/// (l . n_max)(1 + n_max . n) / pi, with n_max of (1). In [0, 2/pi]: 2/pi for light along the normal, 0 for
/// light along the fibre and for light below the horizon (n.l < 0), where the integral itself would stay
/// positive.
double fibre_diffuse(const Vec3& light);

/// The paper's (10) as printed, (l . n_max)(1 - n_min . b) / pi with n_min of (3) and b = n x t. It agrees
/// with fibre_diffuse for l.t > 0 only; for l.t = 0, where n_min is 0/0, its limit from l.t > 0 is returned.
double fibre_diffuse_printed(const Vec3& light);

/// The integral behind both by adaptive quadrature, to `tolerance`: fibre normals n cos a + b sin a for a in
/// [-pi/2, pi/2].
double fibre_diffuse_integral(const Vec3& light, double tolerance = 1e-10);

/// The brightest fibre normal only, l . n_max (Heidrich and Seipel; the paper's comparison), 0 below the
/// horizon.
double fibre_maximum_normal(const Vec3& light);

/// The integral of fibre_diffuse over the hemisphere of lights, 1 + pi/2: radiance towards the eye is colour
/// * Phi * irradiance / kFibreDiffuseNorm, so that a white fibre surface in uniform light is as bright as
/// that light.
inline constexpr double kFibreDiffuseNorm = 1 + kPi / 2;

/// Second-order moments of fibre_diffuse over the hemisphere, for light given as spherical harmonics up to
/// band 2: integrals of Phi times 1, z, x^2, y^2 and z^2.
struct FibreMoments {
  double one, z, xx, yy, zz;
};
/// The same of fibre_maximum_normal.
inline constexpr FibreMoments kMaximumNormalMoments = {kPi * kPi / 2, 8.0 / 3, kPi* kPi / 8,
                                                       3 * kPi* kPi / 16, 3 * kPi* kPi / 16};
inline constexpr FibreMoments kFibreMoments = {1 + kPi / 2, 8 / (3 * kPi) + 2.0 / 3, kPi / 8 + 0.25,
                                               3 * kPi / 16 + 0.25, 3 * kPi / 16 + 0.5};

}  // namespace sateen::brdf
