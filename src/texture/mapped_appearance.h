// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/layered/layered.h"
#include "sateen/texture/lobe_mips.h"

namespace sateen::texture {

/// The albedo of GGX by both alphas and the view, for lobes that change from texel to texel. No isotropic
/// lobe stands for an anisotropic one here: the best mean of its alphas is 0.35 off at 10 : 1.
class GgxAlbedoTable {
 public:
  GgxAlbedoTable();
  /// `view` lies in the frame of the lobe's axis; 1 >= alpha_t >= alpha_b > 0. Within 0.03 of ggx_albedo for
  /// ratios up to 10 : 1, alpha_t of 0.04 or more and cosines of 0.02 or more.
  brdf::GgxAlbedo operator()(double alpha_t, double alpha_b, const Vec3& view) const;
  /// rg32f, scale and bias: tiles side by side, each across the root of the view's cosine and down the
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

/// A surface whose normal and GGX lobe come from a filtered chain of maps (lobe_chain.h), over a base, under
/// the lights of a layered material. The maps lie along the mesh's U and V.
class MappedAppearance : public appearance::Appearance {
 public:
  struct Maps {
    LobeMips mips;
    Vec2 repeat{1, 1};  ///< times the maps repeat over uv in [0, 1]
    Vec3 f0{0.04, 0.04, 0.04};
    int lobe_samples = 8;  ///< lookups along the stretched lobe in environment light
  };

  /// `base` holds the diffuse base and all lights; it has neither reflection nor fuzz.
  MappedAppearance(Maps maps, std::unique_ptr<brdf::LayeredAppearance> base);

  /// A material file with "model": "mapped" (docs/materials.md). Throws Error naming file, key and value.
  static std::unique_ptr<appearance::Appearance> read(const std::filesystem::path& path);

  /// Reads level 0: a point has no footprint. The shader reads the level that the pixel asks for.
  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderBinding shader() const override;
  Needs needs() const override { return {.tangents = true, .uvs = true}; }
  bool set_environment(const Image& latitude_longitude) override {
    return base_->set_environment(latitude_longitude);
  }

 private:
  Maps maps_;
  std::unique_ptr<brdf::LayeredAppearance> base_;
  GgxAlbedoTable albedo_;
};

}  // namespace sateen::texture
