// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"

namespace sateen::scene {

/// One linear colour from every side, times occlusion: silhouettes, and the base line of benchmarks.
class Constant final : public appearance::BakedLight {
 public:
  explicit Constant(const Vec3& color) : color_(color) {}

  /// A material {"model": "constant", "color": [r, g, b]}, linear. Throws Error naming `path`.
  static std::unique_ptr<Constant> parse(const std::string& json, const std::filesystem::path& path);

  Vec3 evaluate(const appearance::Surface& surface) const override { return surface.occlusion * color_; }
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;
  std::vector<appearance::Parameter> parameters() const override;
  appearance::ParameterValue get(const std::string& name) const override;
  void set(const std::string& name, const appearance::ParameterValue& value) override;

 private:
  Vec3 color_;
};

}  // namespace sateen::scene
