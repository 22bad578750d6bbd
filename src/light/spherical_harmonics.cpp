// SPDX-License-Identifier: MIT
#include "sateen/light/spherical_harmonics.h"

#include <cmath>

#include "sateen/light/environment.h"

namespace sateen::light {

namespace {

/// The polynomials multiplying c0 .. c8, at a unit direction.
std::array<double, 9> polynomials(const Vec3& d) {
  const double x = d.x();
  const double y = d.y();
  const double z = d.z();
  return {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
}

/// 1 / the integral of each polynomial's square over the sphere.
constexpr std::array<double, 9> kInverseNorms = {1 / (4 * kPi),  3 / (4 * kPi),  3 / (4 * kPi),
                                                 3 / (4 * kPi),  15 / (4 * kPi), 15 / (4 * kPi),
                                                 5 / (16 * kPi), 15 / (4 * kPi), 15 / (16 * kPi)};

}  // namespace

Vec3 SphericalHarmonics9::linear(const Vec3& d) const {
  return c[1] * d.y() + c[2] * d.z() + c[3] * d.x();
}

Vec3 SphericalHarmonics9::quadratic(const Vec3& d) const {
  return c[4] * (d.x() * d.y()) + c[5] * (d.y() * d.z()) + c[6] * (3 * d.z() * d.z() - d.squaredNorm()) +
         c[7] * (d.x() * d.z()) + c[8] * (d.x() * d.x() - d.y() * d.y());
}

SphericalHarmonics9 project_environment(const Image& environment) {
  SphericalHarmonics9 harmonics;
  for (int y = 0; y < environment.height; ++y) {
    const double top = std::cos(kPi * y / environment.height);
    const double bottom = std::cos(kPi * (y + 1) / environment.height);
    const double solid_angle = 2 * kPi / environment.width * (top - bottom);
    for (int x = 0; x < environment.width; ++x) {
      const Vec3 radiance = environment.rgb(x, y).cast<double>() * solid_angle;
      const auto values =
          polynomials(environment_direction({(x + 0.5) / environment.width, (y + 0.5) / environment.height}));
      for (std::size_t i = 0; i < 9; ++i) harmonics.c[i] += radiance * (values[i] * kInverseNorms[i]);
    }
  }
  return harmonics;
}

SphericalHarmonics9 rotated(const SphericalHarmonics9& harmonics, const Mat3& rotation) {
  // Per channel the bands are a constant, a vector and a symmetric traceless matrix: turn those.
  SphericalHarmonics9 turned;
  turned.c[0] = harmonics.c[0];
  for (int channel = 0; channel < 3; ++channel) {
    const auto c = [&](std::size_t i) { return harmonics.c[i][channel]; };
    const Vec3 vector = rotation * Vec3(c(3), c(1), c(2));
    Mat3 matrix;
    matrix << c(8) - c(6), c(4) / 2, c(7) / 2,  //
        c(4) / 2, -c(8) - c(6), c(5) / 2,       //
        c(7) / 2, c(5) / 2, 2 * c(6);
    matrix = (rotation * matrix * rotation.transpose()).eval();
    const auto set = [&](std::size_t i, double value) { turned.c[i][channel] = value; };
    set(1, vector.y());
    set(2, vector.z());
    set(3, vector.x());
    set(4, 2 * matrix(0, 1));
    set(5, 2 * matrix(1, 2));
    set(6, matrix(2, 2) / 2);
    set(7, 2 * matrix(0, 2));
    set(8, (matrix(0, 0) - matrix(1, 1)) / 2);
  }
  return turned;
}

}  // namespace sateen::light
