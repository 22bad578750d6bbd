// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"
#include "sateen/core/image.h"
#include "sateen/matcap/edited_matcap.h"

namespace sateen::matcap {

/// Textures over the surface (Figures 15 and 16), each repeated over uv; empty: everywhere 1, or 0 for
/// roughness.
struct ModulationMaps {
  Image low_color;   ///< factors on the low part, in the space the parts add up in
  Image high_color;  ///< the same for the high part
  Image roughness;   ///< first channel times roughness_scale is added to the high part's variance
  Image occlusion;   ///< first channel multiplies the result, linear
  double roughness_scale = 0.05;  ///< radians^2
  bool any() const {
    return !(low_color.empty() && high_color.empty() && roughness.empty() && occlusion.empty());
  }
};

/// Shows an edited MatCap: evaluate() of edited_matcap.h at the eye-frame normal, times occlusion.
class DecomposedAppearance final : public appearance::Appearance {
 public:
  explicit DecomposedAppearance(EditedMatcap matcap, ModulationMaps maps = {});

  /// A .ktx2 decomposition as it is.
  static std::unique_ptr<appearance::Appearance> read(const std::filesystem::path& path);

  /// A .json material: {"model": "matcap-decomposition", "matcap": "gold.ktx2", "edits": [...]}, optionally
  /// with the pictures "low_color", "high_color", "roughness" (and "roughness_scale") and "occlusion". File
  /// names are beside the material's. Throws Error naming the material for what is missing or unknown.
  static std::unique_ptr<appearance::Appearance> read_material(const std::filesystem::path& path);

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderBinding shader() const override;
  Needs needs() const override { return {.uvs = maps_.any()}; }

 private:
  EditedMatcap matcap_;
  ModulationMaps maps_;
};

}  // namespace sateen::matcap
