// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/core/appearance.h"

namespace sateen {

/// One linear colour from every side, times occlusion: silhouettes, and the base line of benchmarks.
class Constant : public Appearance {
 public:
  explicit Constant(const Vec3& colour) : colour_(colour) {}

  /// A material file {"model": "constant", "colour": [r, g, b]}, linear. Throws Error naming the file.
  static std::unique_ptr<Constant> read(const std::filesystem::path& path);

  Vec3 evaluate(const Surface& surface) const override { return surface.occlusion * colour_; }
  ShaderBinding shader() const override;

 private:
  Vec3 colour_;
};

}  // namespace sateen
