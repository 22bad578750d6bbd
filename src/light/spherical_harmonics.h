// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "sateen/core/image.h"

namespace sateen::light {

/// Light from all directions as real spherical harmonics up to band 2 (Ramamoorthi and Hanrahan 2001),
/// written as the polynomial they are, basis constants multiplied in:
///   L(d) = c0 + c1 y + c2 z + c3 x + c4 x y + c5 y z + c6 (3 z^2 - 1) + c7 x z + c8 (x^2 - y^2).
/// shaders/light/environment.glsl takes the same nine colours.
struct SphericalHarmonics9 {
  std::array<Vec3, 9> c{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                        Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

  /// Band 1 and band 2 of the polynomial at a direction; for vectors of any length they are the linear and
  /// the (traceless) quadratic form.
  Vec3 linear(const Vec3& d) const;
  Vec3 quadratic(const Vec3& d) const;

  Vec3 radiance(const Vec3& d) const { return c[0] + linear(d) + quadratic(d); }
  /// Light convolved with a lobe about d whose Legendre coefficients are w (1 for band 0 if the lobe is
  /// normalised).
  Vec3 lobe(const Vec3& d, const Vec3& w) const {
    return c[0] * w[0] + linear(d) * w[1] + quadratic(d) * w[2];
  }
  /// Irradiance on a surface of normal n: the clamped cosine, (pi, 2 pi / 3, pi / 4).
  Vec3 irradiance(const Vec3& n) const { return lobe(n, {kPi, 2 * kPi / 3, kPi / 4}); }
  /// Mean radiance over the hemisphere about n: what the fuzz slides call the ambient light.
  Vec3 hemisphere_mean(const Vec3& n) const { return lobe(n, {1, 0.5, 0}); }
};

/// Projection of a latitude-longitude picture (light/environment.h), exact for the bands' integrals over each
/// pixel's centre weighted with its solid angle.
SphericalHarmonics9 project_environment(const Image& environment);

/// The same light in a turned frame: harmonics h with h.radiance(rotation * d) = original.radiance(d).
SphericalHarmonics9 rotated(const SphericalHarmonics9& harmonics, const Mat3& rotation);

}  // namespace sateen::light
