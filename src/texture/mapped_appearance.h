// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/diffuse_base.h"
#include "sateen/brdf/ggx_albedo_table.h"
#include "sateen/texture/lobe_mips.h"

namespace sateen::texture {

/// The parameters of a mapped material besides its maps.
struct MappedMaterial {
  Vec2 repeat{1, 1};  ///< times the maps repeat over uv in [0, 1]
  Vec3 f0{0.04, 0.04, 0.04};
  int lobe_samples = 8;  ///< lookups along the stretched lobe in environment light
  brdf::DiffuseBase base;
};

/// A surface whose normal and GGX lobe come from a filtered chain of maps (lobe_chain.h), over a diffuse
/// base. The maps lie along the mesh's U and V, and are read at the level the point's footprint asks for.
class MappedAppearance final : public appearance::Reflectance {
 public:
  MappedAppearance(LobeMips mips, MappedMaterial material);

  /// A material from JSON text with "model": "mapped" (docs/materials.md); lighting keys are left to others.
  /// `path` is what messages call it and where its maps lie. Throws Error naming file, key and value.
  static std::unique_ptr<MappedAppearance> parse(const std::string& json, const std::filesystem::path& path);

  std::unique_ptr<Point> at(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  appearance::Needs needs() const override { return {.tangents = true, .uvs = true}; }

  std::vector<appearance::Parameter> parameters() const override;
  appearance::ParameterValue get(const std::string& name) const override;
  void set(const std::string& name, const appearance::ParameterValue& value) override;

 private:
  LobeMips mips_;
  MappedMaterial material_;
  brdf::GgxAlbedoTable albedo_;
  std::shared_ptr<const TextureData> normals_texture_;
  std::shared_ptr<const TextureData> lobes_texture_;
  std::shared_ptr<const TextureData> albedo_texture_;
};

/// base.model, base.color, base.azimuth, f0, repeat_u, repeat_v, lobe_samples.
std::span<const appearance::ParameterField<MappedMaterial>> mapped_parameters();

}  // namespace sateen::texture
