// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <future>
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
///
/// While it is being changed the full formula is drawn, in which the light's turn, colours and roughness are
/// uniforms. When nothing was changed between two calls of settle(), and no texture varies it over the
/// surface, all of it is baked into one table of normals on another thread, and one lookup is drawn from then
/// on.
class DecomposedAppearance final : public appearance::BakedLight {
 public:
  explicit DecomposedAppearance(EditedMatcap matcap, ModulationMaps maps = {});

  /// A .ktx2 decomposition as it is.
  static std::unique_ptr<DecomposedAppearance> read(const std::filesystem::path& path);

  /// A material {"model": "matcap-decomposition", "matcap": "gold.ktx2", "edits": [...]}, optionally
  /// with the pictures "low_color", "high_color", "roughness" (and "roughness_scale") and "occlusion". File
  /// names are beside the material's. Throws Error naming the material for what is missing or unknown.
  static std::unique_ptr<DecomposedAppearance> parse(const std::string& json,
                                                     const std::filesystem::path& path);

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  appearance::Needs needs() const override { return {.uvs = maps_.any()}; }

  /// turn_x, turn_y, turn_z; of each part its color and intensity; high.roughness.
  std::vector<appearance::Parameter> parameters() const override;
  appearance::ParameterValue get(const std::string& name) const override;
  void set(const std::string& name, const appearance::ParameterValue& value) override;
  void settle(bool wait = false) override;

  /// What can be changed from frame to frame.
  struct Live {
    EditedMatcap matcap;
    Vec3 turn{0, 0, 0};         ///< of the light after all edits, radians about x, then y, then z
    double added_variance = 0;  ///< of the high part, radians^2
  };

 private:
  Live live_;
  ModulationMaps maps_;
  std::shared_ptr<const TextureData> sphere_maps_;
  std::array<std::shared_ptr<const TextureData>, 4> modulation_;
  std::shared_ptr<const TextureData> normals_;  ///< everything baked; null while it is being changed
  bool quiet_ = true;                           ///< nothing was set since the last settle()
  std::future<std::shared_ptr<const TextureData>> baking_;
  std::uint64_t baking_revision_ = 0;
};

}  // namespace sateen::matcap
