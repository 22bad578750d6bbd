// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/brdf/layered.h"
#include "sateen/core/appearance.h"
#include "sateen/texture/lobe_mips.h"

namespace sateen {

/// The albedo of GGX by angle and roughness, for lobes that change from texel to texel. An anisotropic lobe
/// is looked up as the isotropic one that a view meets: alpha^2 = vx^2 alpha_t^2 + vy^2 alpha_b^2 + vz^2
/// alpha_t alpha_b for a view (vx, vy, vz) in the frame of its axis. Rough at grazing views: up to 0.32 from
/// ggx_albedo where the view's cosine is 0.05 and the alphas are as far apart as 10 : 1.
class GgxAlbedoTable {
 public:
  GgxAlbedoTable();
  GgxAlbedo operator()(double alpha_t, double alpha_b, const Vec3& view) const;
  /// rg32f, scale and bias; across the cosine of the view, down sqrt(alpha), both from 0 to 1 between the
  /// middles of the first and last texel.
  std::shared_ptr<const TextureData> texture() const;
  static constexpr int kSize = 32;

 private:
  Image table_;
};

/// A surface whose normal and GGX lobe come from a filtered chain of maps (lobe_chain.h), over a base, under
/// the lights of a layered material. The maps lie along the mesh's U and V.
class MappedAppearance : public Appearance {
 public:
  struct Maps {
    LobeMips mips;
    Vec2 repeat{1, 1};  ///< times the maps repeat over uv in [0, 1]
    Vec3 f0{0.04, 0.04, 0.04};
    int lobe_samples = 8;  ///< lookups along the stretched lobe in environment light
  };

  /// `base` holds the diffuse base and all lights; it has neither reflection nor fuzz.
  MappedAppearance(Maps maps, std::unique_ptr<LayeredAppearance> base);

  /// A material file with "model": "mapped" (docs/materials.md). Throws Error naming file, key and value.
  static std::unique_ptr<Appearance> read(const std::filesystem::path& path);

  /// Reads level 0: a point has no footprint. The shader reads the level that the pixel asks for.
  Vec3 evaluate(const Surface& surface) const override;
  ShaderBinding shader() const override;
  Needs needs() const override { return {.tangents = true, .uvs = true}; }
  bool set_environment(const Image& latitude_longitude) override {
    return base_->set_environment(latitude_longitude);
  }

 private:
  Maps maps_;
  std::unique_ptr<LayeredAppearance> base_;
  GgxAlbedoTable albedo_;
};

}  // namespace sateen
