// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "sateen/brdf/ggx.h"
#include "sateen/core/vector.h"

namespace sateen::texture {

// The GGX lobe of a texel is two alphas and an axis, or the 2 x 2 symmetric matrix that has the squared
// alphas as eigenvalues:
//   S2 = R(angle) diag(alpha_t^2, alpha_b^2) R(angle)^T,
// in the tangent plane with x along increasing U and y along increasing V (V up). Axes are lines: angle and
// angle + pi are the same lobe. Average the matrices, never angles. With the normal added it is the 3 x 3
// matrix of the SGGX distribution (Heitz et al. 2015): S = M_n [S2 0; 0 1] M_n^T.

/// The matrix with its eigenvalues clamped to [kMinimumAlpha^2, 1], as roughness_from_matrix does:
/// interpolation and quantisation can make any.
Mat2 guarded(const Mat2& s);

/// How the three channels of an anisotropy map hold S2. Both fit 8 bits and BC7.
enum class AnisotropyEncoding {
  correlation,  ///< the slides' [sqrt(Sxx), Sxy / (2 sqrt(Sxx Syy)) + 1/2, sqrt(Syy)]
  root,  ///< the matrix square root Q = S2^(1/2), whose eigenvalues are the alphas: [Qxx, Qxy + 1/2, Qyy]
};

/// Names as at the command line and in files: correlation, root. Throws Error for another.
AnisotropyEncoding anisotropy_encoding_from_name(const std::string& name);
std::string name_of(AnisotropyEncoding encoding);

/// Channels in [0, 1] of a positive matrix (guarded first).
Vec3 encode_anisotropy(const Mat2& s, AnisotropyEncoding encoding);

/// The matrix of three channels as they are: once they were interpolated or compressed it may be singular, or
/// larger than 1; with channels outside [0, 1] also negative. Follow with roughness_from_matrix or guarded.
Mat2 decode_anisotropy(const Vec3& channels, AnisotropyEncoding encoding);

/// The smallest rotation that takes +z to the unit normal n, n.z > -1: columns are the normal-mapped tangent,
/// bitangent and n. Jasmin Patry, "Samurai Shading in Ghost of Tsushima" (2020), matrix M_n.
inline Mat3 normal_frame(const Vec3& n) {
  const double k = 1 / std::max(1 + n.z(), 1e-9);
  Mat3 m;
  m << 1 - n.x() * n.x() * k, -n.x() * n.y() * k, n.x(),  //
      -n.x() * n.y() * k, 1 - n.y() * n.y() * k, n.y(),   //
      -n.x(), -n.y(), n.z();
  return m;
}

/// The SGGX matrix of a texel: eigenvalue 1 along the unit normal, S2 across it.
Mat3 sroughness_matrix(const Vec3& normal, const Mat2& s);

/// How the normal comes back out of a filtered SGGX matrix.
enum class NormalSolver {
  eigen,  ///< the exact eigenvector of the largest eigenvalue; the mean normal where it is ambiguous
  power_iteration,  ///< the slides': a few steps from +z; wrong where two eigenvalues come close
};

/// The eigenvector of the largest eigenvalue of a symmetric matrix, unit, on the side of `fallback` (unit).
/// Closed form. The closer the two largest eigenvalues, the less the vector means: for a relative gap below
/// 0.2 the result is `fallback`, from 0.4 on the eigenvector, between them a smooth mix, so that neighbouring
/// texels agree. The limits are those with the least error on real maps with alphas of 0.87 and 0.04
/// (docs/anisotropy-maps.md).
Vec3 principal_axis(const Mat3& s, const Vec3& fallback);

/// The slides' power iteration from +z.
Vec3 principal_axis_by_power_iteration(const Mat3& s, int steps = 8);

/// The 2 x 2 part about a unit normal, scaled so that the normal's own eigenvalue is 1: (M^T S M) / (n^T S
/// n).
Mat2 tangent_part(const Mat3& s, const Vec3& normal);

}  // namespace sateen::texture
