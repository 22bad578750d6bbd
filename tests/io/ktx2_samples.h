// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "sateen/io/ktx2.h"

namespace sateen::test {

inline constexpr io::VkFormat kAllFormats[]{
    io::VkFormat::r8_unorm,      io::VkFormat::rg8_unorm,     io::VkFormat::rgba8_unorm,
    io::VkFormat::rgba8_srgb,    io::VkFormat::rgba16_sfloat, io::VkFormat::rgba32_sfloat,
    io::VkFormat::bc1_rgb_unorm, io::VkFormat::bc3_unorm,     io::VkFormat::bc4_unorm,
    io::VkFormat::bc5_unorm,     io::VkFormat::bc6h_ufloat,   io::VkFormat::bc7_unorm,
    io::VkFormat::bc7_srgb,
};

/// A texture of noise whose bytes depend on `seed` alone; even bytes are 0 so that compression has something
/// to do.
inline io::Ktx2 noise_texture(io::VkFormat format, std::uint32_t width, std::uint32_t height,
                              std::uint32_t depth = 0, std::uint32_t levels = 1, std::uint32_t layers = 0,
                              std::uint32_t faces = 1, unsigned seed = 1) {
  io::Ktx2 texture{format, width, height, depth, layers, faces, {}, {}};
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < levels; ++i) {
    std::vector<std::byte> level(io::ktx2_level_bytes(texture, i));
    for (std::size_t j = 1; j < level.size(); j += 2) level[j] = static_cast<std::byte>(random() & 0xff);
    texture.levels.push_back(std::move(level));
  }
  return texture;
}

/// A little-endian number in a file's bytes.
template <typename T>
T number_at(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

template <typename T>
void put_number(std::vector<std::byte>& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

// Offsets of the header's fields, KTX 2.0 section 3.
namespace ktx2_offset {
inline constexpr std::size_t format = 12;
inline constexpr std::size_t type_size = 16;
inline constexpr std::size_t width = 20;
inline constexpr std::size_t height = 24;
inline constexpr std::size_t depth = 28;
inline constexpr std::size_t layers = 32;
inline constexpr std::size_t faces = 36;
inline constexpr std::size_t levels = 40;
inline constexpr std::size_t supercompression = 44;
inline constexpr std::size_t descriptor = 48;
inline constexpr std::size_t metadata = 56;
inline constexpr std::size_t level_index = 80;
}  // namespace ktx2_offset

}  // namespace sateen::test
