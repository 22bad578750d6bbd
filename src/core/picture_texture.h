// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/appearance.h"
#include "sateen/core/image.h"

namespace sateen {

/// A picture as a half-float RGBA texture whose coordinate v runs up, so that (0, 0) is the picture's lower
/// left corner. Grey is repeated, a missing alpha is 1; values beyond the range of half floats are clamped to
/// it.
TextureData picture_texture(const Image& picture, TextureData::Wrap wrap = TextureData::Wrap::clamp,
                            bool generate_mipmaps = false);

}  // namespace sateen
