// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "sateen/io/file.h"
#include "sateen/texture/block_compression.h"

namespace sateen::test {

/// Decodes blocks with OpenImageIO, an implementation that is not ours, by way of a DDS file: RGBA, 8 bits.
inline std::vector<std::uint8_t> decode_blocks(texture::BlockFormat format, std::span<const std::byte> blocks,
                                               int width, int height, const std::filesystem::path& file) {
  std::vector<std::uint32_t> header(32);  // magic and the 124 bytes of DDS_HEADER
  header[0] = 0x20534444;                 // "DDS "
  header[1] = 124;
  header[2] = 0x1 | 0x2 | 0x4 | 0x1000 | 0x80000;  // caps, height, width, pixel format, linear size
  header[3] = static_cast<std::uint32_t>(height);
  header[4] = static_cast<std::uint32_t>(width);
  header[5] = static_cast<std::uint32_t>(blocks.size());
  header[19] = 32;
  header[20] = 0x4;     // the code says what it is
  header[27] = 0x1000;  // a texture
  if (format == texture::BlockFormat::bc1 || format == texture::BlockFormat::bc3) {
    header[21] = format == texture::BlockFormat::bc1 ? 0x31545844 : 0x35545844;  // "DXT1", "DXT5"
  } else {
    header[21] = 0x30315844;  // "DX10": DXGI format BC5 or BC7 UNORM; 2D; one of them
    for (const std::uint32_t v : {format == texture::BlockFormat::bc5 ? 83u : 98u, 3u, 0u, 1u, 0u})
      header.push_back(v);
  }
  std::vector<std::byte> bytes(header.size() * 4 + blocks.size());
  std::memcpy(bytes.data(), header.data(), header.size() * 4);
  std::memcpy(bytes.data() + header.size() * 4, blocks.data(), blocks.size());
  io::write_bytes(file, bytes);

  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) return {};
  const int channels = input->spec().nchannels;
  std::vector<std::uint8_t> read(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                 static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, read.data())) return {};
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 255);
  for (std::size_t i = 0; i * 4 < rgba.size(); ++i) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      rgba[i * 4 + c] = read[i * static_cast<std::size_t>(channels) + c];
    }
  }
  return rgba;
}

}  // namespace sateen::test
