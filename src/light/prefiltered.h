// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/core/texture_data.h"

namespace sateen::light {

/// An environment map blurred with isotropic GGX lobes of growing roughness (normal and view along the lookup
/// direction, as Karis 2013), in the mip levels of one latitude-longitude texture: what the GPU reads instead
/// of integrating.
///
/// Level i of n holds perceptual roughness i / (n - 1), alpha = roughness^2; level 0 is the map itself.
/// Values are held as halves, as on the GPU, so that evaluate() and the shader read the same numbers.
class PrefilteredEnvironment {
 public:
  /// `width` of level 0, a power of two; levels halve down to 32 x 16.
  explicit PrefilteredEnvironment(const Image& environment, int width = 512, int samples = 128);

  int levels() const { return static_cast<int>(levels_.size()); }
  const Image& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
  /// Radiance of a unit direction for a GGX alpha: bilinear in two levels, linear between them.
  Vec3 radiance(const Vec3& direction, double alpha) const;
  /// rgba16f with all levels, u repeating; row 0 is the nadir (v up).
  const std::shared_ptr<const TextureData>& texture() const { return texture_; }

 private:
  std::shared_ptr<const TextureData> make_texture() const;

  std::vector<Image> levels_;
  std::shared_ptr<const TextureData> texture_;
};

}  // namespace sateen::light
