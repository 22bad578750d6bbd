// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sateen/texture/anisotropy.h"

namespace sateen::texture {

/// How a normal map and its anisotropy map are averaged together. Each method turns a texel into moments that
/// average linearly, and averaged moments back into a normal and a matrix; any linear filter may stand
/// between.
enum class FilterMethod {
  /// Average of the 3 x 3 SGGX matrices: "Samurai Shading in Ghost of Tsushima" (2020). The normals' variance
  /// adds
  /// once: alpha^2 + Var of the slopes.
  sggx,
  /// The same with the variance of the footprint's normals counted twice, S + E[nn^T] - E[n]E[n]^T: the
  /// alpha^2 + 2 Var
  /// that matches the width of averaged GGX lobes.
  sggx_variance,
  /// LEAN mapping (Olano and Baker 2010) for GGX through sigma = alpha / sqrt(2): slopes and their second
  /// moments.
  lean,
  /// What mip-mapping the two textures on their own does: mean normal, mean channels. For comparison.
  naive,
};

/// Names as at the command line: sggx, sggx-variance, lean, naive. Throws Error for another.
FilterMethod filter_method_from_name(const std::string& name);
std::string name_of(FilterMethod method);

struct FilterOptions {
  FilterMethod method = FilterMethod::sggx_variance;
  NormalSolver solver = NormalSolver::eigen;               ///< of the SGGX methods
  AnisotropyEncoding encoding = AnisotropyEncoding::root;  ///< whose channels `naive` averages
  bool isotropic = false;  ///< alpha_t = alpha_b in the result, for engines without anisotropy
};

inline constexpr int kMoments = 9;

/// One texel: a unit normal in tangent space (green up) and its lobe.
struct LobeTexel {
  Vec3 normal{0, 0, 1};
  Mat2 s = Mat2::Identity();
};

/// The kMoments values of a texel; those the method does not need are 0.
void pack_moments(const LobeTexel& texel, const FilterOptions& options, std::span<float, kMoments> moments);

/// The texel of averaged moments: unit normal with z > 0, guarded matrix.
LobeTexel unpack_moments(std::span<const float, kMoments> moments, const FilterOptions& options);

/// The isotropic matrix with the same mean variance of slopes: alpha^2 is the mean of both. (Their geometric
/// mean, which keeps the peak, comes no closer to averaged lobes.)
Mat2 isotropic_matrix(const Mat2& s);

}  // namespace sateen::texture
