// SPDX-License-Identifier: MIT
#include "sateen/core/picture_texture.h"

#include <algorithm>
#include <cstring>

namespace sateen {

TextureData picture_texture(const Image& picture, TextureData::Wrap wrap, bool generate_mipmaps) {
  TextureData texture;
  texture.format = TextureData::Format::rgba16f;
  texture.width = picture.width;
  texture.height = picture.height;
  texture.wrap_u = texture.wrap_v = wrap;
  texture.generate_mipmaps = generate_mipmaps;

  const Image rgba = with_channels(picture, 4);
  std::vector<Half> texels(rgba.data.size());
  const std::size_t row = static_cast<std::size_t>(rgba.width) * 4;
  const float largest = static_cast<float>(std::numeric_limits<Half>::max());
  for (int y = 0; y < rgba.height; ++y) {
    const float* in = rgba.data.data() + rgba.index(0, y);
    Half* out = texels.data() + static_cast<std::size_t>(rgba.height - 1 - y) * row;
    std::transform(in, in + row, out, [&](float v) { return Half(std::clamp(v, -largest, largest)); });
  }
  texture.levels.resize(1);
  texture.levels[0].resize(texels.size() * sizeof(Half));
  std::memcpy(texture.levels[0].data(), texels.data(), texture.levels[0].size());
  return texture;
}

}  // namespace sateen
