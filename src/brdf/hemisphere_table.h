// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sateen/core/texture_data.h"
#include "sateen/core/vector.h"

namespace sateen::brdf {

/// Four values for every direction of the upper hemisphere, tabulated on a square by the hemi-octahedral map
/// (no trigonometry in the shader) and read bilinearly. The first and last texels of a row lie on the
/// horizon, and the middle of the square is the normal. shaders/appearance/hemisphere_table.glsl reads the
/// same texels.
class HemisphereTable {
 public:
  HemisphereTable() = default;
  /// Calls `f` once a texel, in parallel. `size` is odd, so that one texel is the normal.
  HemisphereTable(int size, const std::function<Vec4(const Vec3&)>& f);

  int size() const { return size_; }
  /// Directions below the horizon read the horizon. The GPU holds halves.
  Vec4 operator()(const Vec3& direction) const;
  /// rgba16f.
  std::shared_ptr<const TextureData> texture() const;

 private:
  std::size_t texel_index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  }

  int size_ = 0;
  std::vector<Vec4f> texels_;
};

/// Unit direction over a point of [-1, 1]^2, and back.
Vec3 hemisphere_direction(const Vec2& square);
Vec2 hemisphere_square(const Vec3& direction);

}  // namespace sateen::brdf
