// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sateen/brdf/ggx.h"
#include "sateen/core/image.h"
#include "sateen/core/texture_data.h"

namespace sateen::brdf {

/// The albedo of GGX by both alphas and the view, for lobes that change from texel to texel. No isotropic
/// lobe stands for an anisotropic one here: the best mean of its alphas is 0.35 off at 10 : 1.
class GgxAlbedoTable {
 public:
  GgxAlbedoTable();
  /// `view` lies in the frame of the lobe's axis; 1 >= alpha_t >= alpha_b > 0. Within 0.03 of ggx_albedo for
  /// ratios up to 10 : 1, alpha_t of 0.04 or more and cosines of 0.02 or more.
  GgxAlbedo operator()(double alpha_t, double alpha_b, const Vec3& view) const;
  /// rg16f, scale and bias: tiles side by side, each across the root of the view's cosine and down the
  /// cosine of its azimuth; tiles across the root of alpha_t and down that of alpha_b / alpha_t. Every
  /// coordinate runs from 0 to 1 between the middles of the first and last texel or tile.
  std::shared_ptr<const TextureData> texture() const;
  static constexpr int kCosines = 16;
  static constexpr int kAzimuths = 9;
  static constexpr int kAlphas = 12;
  static constexpr int kRatios = 8;

 private:
  Image table_;
};

}  // namespace sateen::brdf
