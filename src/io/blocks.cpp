// SPDX-License-Identifier: MIT
#include "sateen/io/blocks.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/module.h"

namespace sateen::io {
namespace {

constexpr std::uint32_t kDxgiBc5 = 83;
constexpr std::uint32_t kDxgiBc7 = 98;
constexpr std::size_t kBlockBytes = 16;

/// A DDS file around the blocks: magic, DDS_HEADER, DDS_HEADER_DXT10.
std::vector<std::byte> dds(std::uint32_t dxgi, std::span<const std::byte> blocks, int width, int height) {
  std::vector<std::uint32_t> header(37);
  header[0] = 0x20534444;                          // "DDS "
  header[1] = 124;                                 // bytes of the header
  header[2] = 0x1 | 0x2 | 0x4 | 0x1000 | 0x80000;  // caps, height, width, pixel format, linear size
  header[3] = static_cast<std::uint32_t>(height);
  header[4] = static_cast<std::uint32_t>(width);
  header[5] = static_cast<std::uint32_t>(blocks.size());
  header[19] = 32;          // bytes of the pixel format
  header[20] = 0x4;         // which a code names
  header[21] = 0x30315844;  // "DX10"
  header[27] = 0x1000;      // a texture
  header[32] = dxgi;
  header[33] = 3;  // two-dimensional
  header[35] = 1;  // one of them
  std::vector<std::byte> bytes(header.size() * 4 + blocks.size());
  std::memcpy(bytes.data(), header.data(), header.size() * 4);
  std::ranges::copy(blocks, bytes.begin() + static_cast<std::ptrdiff_t>(header.size() * 4));
  return bytes;
}

}  // namespace

Image decode_blocks(VkFormat format, std::span<const std::byte> blocks, int width, int height,
                    const std::string& name) {
  if (format != VkFormat::bc5_unorm && format != VkFormat::bc7_unorm) {
    throw Error(fmt::format("{}: only BC5 and BC7 blocks are decoded", name));
  }
  const auto across = static_cast<std::size_t>((width + 3) / 4);
  const auto down = static_cast<std::size_t>((height + 3) / 4);
  if (width < 1 || height < 1 || blocks.size() != across * down * kBlockBytes) {
    throw Error(
        fmt::format("{}: {} bytes of blocks do not make {} x {} texels", name, blocks.size(), width, height));
  }
  const std::vector<std::byte> file =
      dds(format == VkFormat::bc5_unorm ? kDxgiBc5 : kDxgiBc7, blocks, width, height);
  const auto source =
      oiio_module(fmt::format("{}: decoding its BC5 or BC7 blocks", name)).open_dds(file, name);
  const PictureHeader& header = source->header();
  Image image(width, height, header.channels);
  std::vector<std::uint8_t> texels(header.row_bytes() * static_cast<std::size_t>(height));
  if (header.samples != SampleType::u8 || header.width != width || header.height != height)
    throw Error(fmt::format("{}: its blocks cannot be decoded", name));
  source->read(height, texels.data());
  std::ranges::transform(texels, image.data.begin(),
                         [](std::uint8_t v) { return static_cast<float>(v) * (1 / 255.0f); });
  return image;
}

}  // namespace sateen::io
