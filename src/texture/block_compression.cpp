// SPDX-License-Identifier: MIT
#include "sateen/texture/block_compression.h"

#include <algorithm>

#include <squish.h>

#include "sateen/core/parallel.h"
#include "sateen/texture/bc5.h"

namespace sateen::texture {
namespace {

BlockRgba8 block_at(std::span<const std::uint8_t> rgba, int width, int height, int bx, int by) {
  BlockRgba8 block;
  for (int i = 0; i < 16; ++i) {
    const int x = std::min(bx * 4 + i % 4, width - 1);
    const int y = std::min(by * 4 + i / 4, height - 1);
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
    std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(at), 4,
                block[static_cast<std::size_t>(i)].begin());
  }
  return block;
}

}  // namespace

std::size_t block_bytes(BlockFormat format) {
  return format == BlockFormat::bc1 ? 8 : 16;
}

io::VkFormat vk_format(BlockFormat format, bool srgb) {
  switch (format) {
    case BlockFormat::bc1:
      return io::VkFormat::bc1_rgb_unorm;
    case BlockFormat::bc3:
      return io::VkFormat::bc3_unorm;
    case BlockFormat::bc5:
      return io::VkFormat::bc5_unorm;
    case BlockFormat::bc7:
      break;
  }
  return srgb ? io::VkFormat::bc7_srgb : io::VkFormat::bc7_unorm;
}

std::vector<std::byte> compress_blocks(BlockFormat format, std::span<const std::uint8_t> rgba, int width,
                                       int height, const Bc7Options& options) {
  const int across = (width + 3) / 4;
  const int down = (height + 3) / 4;
  const std::size_t bytes = block_bytes(format);
  std::vector<std::byte> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down) * bytes);
  parallel_for(down, [&](int by) {
    for (int bx = 0; bx < across; ++bx) {
      const BlockRgba8 block = block_at(rgba, width, height, bx, by);
      const std::size_t index =
          static_cast<std::size_t>(by) * static_cast<std::size_t>(across) + static_cast<std::size_t>(bx);
      std::byte* out = blocks.data() + index * bytes;
      switch (format) {
        case BlockFormat::bc1:
        case BlockFormat::bc3:
          squish::Compress(
              block[0].data(), out,
              (format == BlockFormat::bc1 ? squish::kDxt1 : squish::kDxt5) | squish::kColourClusterFit);
          break;
        case BlockFormat::bc5:
          encode_bc5_block(block, std::span<std::byte, 16>(out, 16));
          break;
        case BlockFormat::bc7:
          encode_bc7_block(block, options, std::span<std::byte, 16>(out, 16));
          break;
      }
    }
  });
  return blocks;
}

}  // namespace sateen::texture
