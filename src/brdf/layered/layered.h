// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "sateen/appearance/appearance.h"
#include "sateen/brdf/layered/material.h"

namespace sateen::brdf {

struct LayeredTables;

/// A LayeredMaterial under the scene's lighting. Lamps follow the models' formulas; light of the surroundings
/// comes from prefiltered tables and harmonics, the same here and in shaders/appearance/layered.glsl.
///
/// set() of a parameter on which expensive tables hang starts a thread that makes them; until settle() takes
/// them up the material is what it was before.
class LayeredAppearance final : public appearance::Reflectance {
 public:
  /// Makes the tables now.
  explicit LayeredAppearance(LayeredMaterial material);
  ~LayeredAppearance() override;

  /// A material from JSON text with "model": "layered" and, which are left to others, lighting keys and those
  /// of research/slides.h; `path` is what messages call it and where its pictures lie. Throws Error naming
  /// file, key and value.
  static std::unique_ptr<LayeredAppearance> parse(const std::string& json, const std::filesystem::path& path);

  std::unique_ptr<Point> at(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  appearance::Needs needs() const override;

  std::vector<appearance::Parameter> parameters() const override;
  appearance::ParameterValue get(const std::string& name) const override;
  void set(const std::string& name, const appearance::ParameterValue& value) override;
  void settle(bool wait = false) override;

  /// What is shown now.
  const LayeredMaterial& material() const { return material_; }
  const LayeredTables& tables() const { return *tables_; }

 private:
  void start();

  LayeredMaterial wanted_;    ///< as it was set
  LayeredMaterial material_;  ///< normalised
  std::shared_ptr<const LayeredTables> tables_;
  std::shared_ptr<const TextureData> fibres_;  ///< material_.fuzz_fibres for the shader
  struct Made {
    LayeredMaterial material;
    std::shared_ptr<const LayeredTables> tables;
  };
  std::future<Made> making_;
};

}  // namespace sateen::brdf
