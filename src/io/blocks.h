// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "sateen/core/image.h"
#include "sateen/io/ktx2.h"

namespace sateen::io {

/// The texels of one level of 4 x 4 blocks (BC5 or BC7), decoded by OpenImageIO: two channels for BC5, four
/// for BC7, in [0, 1], row 0 as stored. `name` is what messages call it. Throws Error for another format or
/// when there are not as many blocks as the size needs.
Image decode_blocks(VkFormat format, std::span<const std::byte> blocks, int width, int height,
                    const std::string& name);

}  // namespace sateen::io
