// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sateen/core/image.h"
#include "sateen/core/texture_data.h"

namespace sateen {

/// A picture as a half-float RGBA texture whose coordinate v runs up, so that (0, 0) is the picture's lower
/// left corner. Grey is repeated, a missing alpha is 1; values beyond the range of half floats are clamped to
/// it.
TextureData picture_texture(const Image& picture, TextureData::Wrap wrap = TextureData::Wrap::clamp,
                            bool generate_mipmaps = false);

/// What the GPU reads of a repeating picture_texture without mipmaps: bilinear at `uv`, v up. `out` has no
/// more entries than the picture has channels.
void sample_repeating(const Image& picture, const Vec2& uv, std::span<double> out);

}  // namespace sateen
