// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"

namespace sateen::scene {

/// One linear colour from every side, times occlusion: silhouettes, and the base line of benchmarks.
class Constant : public appearance::Appearance {
 public:
  explicit Constant(const Vec3& colour) : colour_(colour) {}

  /// A material file {"model": "constant", "colour": [r, g, b]}, linear. Throws Error naming the file.
  static std::unique_ptr<Constant> read(const std::filesystem::path& path);

  Vec3 evaluate(const appearance::Surface& surface) const override { return surface.occlusion * colour_; }
  appearance::ShaderBinding shader() const override;

 private:
  Vec3 colour_;
};

}  // namespace sateen::scene
