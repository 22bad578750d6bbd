// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "sateen/appearance/appearance.h"
#include "sateen/core/image.h"

namespace sateen::matcap {

/// A plain MatCap (Sloan et al. 2001; Magri et al. 2016, section 3): one picture of a lit sphere, looked up
/// by the x and y of the eye-frame normal. Pixel-centred: texel x covers n_x = 2 (x + 0.5) / size - 1. For
/// isotropic materials.
class MatCap final : public appearance::BakedLight {
 public:
  /// A square picture of the sphere, linear light, touching all four edges. Texels outside the disc are
  /// replaced from the rim, alpha is divided out. Throws Error when it is not square.
  explicit MatCap(Image picture);

  /// Any picture file. Throws Error naming it when it cannot be read or is not square.
  static std::unique_ptr<MatCap> read(const std::filesystem::path& path);

  const Image& picture() const { return picture_; }

  /// Bilinear, linear RGB. `disc` is the (x, y) of a normal; beyond the square the edge is repeated.
  Vec3 lookup(const Vec2& disc) const;

  Vec3 evaluate(const appearance::Surface& surface) const override;
  appearance::ShaderModule shader() const override;
  appearance::ShaderValues values() const override;

 private:
  Image picture_;  ///< three channels
  std::shared_ptr<const TextureData> texture_;
};

}  // namespace sateen::matcap
