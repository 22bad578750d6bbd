// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sateen/io/ktx2.h"
#include "sateen/texture/bc7.h"

namespace sateen::texture {

/// Block formats for 8-bit data; every 4 x 4 texels become 8 (bc1) or 16 bytes.
enum class BlockFormat {
  bc1,  ///< RGB, half a byte a texel
  bc3,  ///< RGB as bc1, alpha on its own
  bc5,  ///< two independent channels: the normal's x and y
  bc7,  ///< RGB or RGBA, the best of them
};

std::size_t block_bytes(BlockFormat format);
io::VkFormat vk_format(BlockFormat format, bool srgb = false);

/// Compresses a picture of 8-bit RGBA texels (width * height * 4 bytes, row by row) into blocks, row by row
/// of blocks. The blocks at the right and lower border repeat the last texel. BC1 and BC3 are libsquish's.
/// Works on several rows of blocks at a time; the result does not depend on the number of threads.
std::vector<std::byte> compress_blocks(BlockFormat format, std::span<const std::uint8_t> rgba, int width,
                                       int height, const Bc7Options& options = {});

}  // namespace sateen::texture
