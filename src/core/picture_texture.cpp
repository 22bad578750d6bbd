// SPDX-License-Identifier: MIT
#include "sateen/core/picture_texture.h"

#include <algorithm>
#include <cmath>
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

void sample_repeating(const Image& picture, const Vec2& uv, std::span<double> out) {
  const double x = (uv.x() - std::floor(uv.x())) * picture.width - 0.5;
  const double y = (1 - (uv.y() - std::floor(uv.y()))) * picture.height - 0.5;
  const auto column = static_cast<int>(std::floor(x));
  const auto row = static_cast<int>(std::floor(y));
  std::ranges::fill(out, 0.0);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight = (i == 0 ? 1 - (x - column) : x - column) * (j == 0 ? 1 - (y - row) : y - row);
      const auto texel = picture.pixel((column + i + picture.width) % picture.width,
                                       (row + j + picture.height) % picture.height);
      for (std::size_t c = 0; c < out.size(); ++c) out[c] += weight * texel[c];
    }
  }
}

}  // namespace sateen
