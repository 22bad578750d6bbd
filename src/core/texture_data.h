// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sateen {

/// A texture as plain data: what an appearance asks the GPU to hold.
struct TextureData {
  enum class Shape { image_2d, volume_3d, array_2d, cube };
  enum class Format {
    rgba8,    ///< 4 bytes, linear
    srgba8,   ///< 4 bytes, colour decoded from sRGB on fetch
    rgba16f,  ///< 4 halves
    rg16f,    ///< 2 halves
    rgba32f,  ///< 4 floats; WebGL filters them only with an extension: tables are halves
  };
  enum class Wrap { clamp, repeat };

  Shape shape = Shape::image_2d;
  Format format = Format::rgba16f;
  int width = 0;
  int height = 0;
  int depth = 1;  ///< slices of a volume, layers of an array, 6 for a cube
  Wrap wrap_u = Wrap::clamp;
  Wrap wrap_v = Wrap::clamp;
  Wrap wrap_w = Wrap::clamp;
  bool generate_mipmaps = false;  ///< otherwise exactly the given levels are used
  /// One tightly packed array a mip level, layer by layer, row 0 first. Row 0 is where the texture coordinate
  /// v is 0: pictures (row 0 on top) are flipped by whoever fills this.
  std::vector<std::vector<std::byte>> levels;
};

/// The values as the halves of a texture level, clamped to what halves hold.
std::vector<std::byte> half_bytes(std::span<const float> values);

}  // namespace sateen
