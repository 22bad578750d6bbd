// SPDX-License-Identifier: MIT
#include "sateen/io/ktx2_format.h"

#include <algorithm>
#include <array>
#include <bit>

namespace sateen::io {
namespace {

using Sample = TexelLayout::Sample;

constexpr std::uint8_t kAlpha = 15;
constexpr std::uint8_t kModelRgbsda = 1;
constexpr std::uint8_t kModelBc1 = 128;
constexpr std::uint8_t kModelBc3 = 130;
constexpr std::uint8_t kModelBc4 = 131;
constexpr std::uint8_t kModelBc5 = 132;
constexpr std::uint8_t kModelBc6h = 133;
constexpr std::uint8_t kModelBc7 = 134;

/// `channels` equal numbers side by side: red, green, blue, alpha.
TexelLayout plain(VkFormat format, std::uint32_t channels, std::uint32_t bytes, bool srgb, bool floating) {
  TexelLayout layout{format, bytes, 1, channels * bytes, kModelRgbsda, srgb, {}};
  for (std::uint32_t c = 0; c < channels; ++c) {
    Sample sample;
    sample.bit_offset = static_cast<std::uint16_t>(8 * bytes * c);
    sample.bits = static_cast<std::uint16_t>(8 * bytes);
    sample.channel = c == 3 ? kAlpha : static_cast<std::uint8_t>(c);
    if (floating) {
      sample.qualifiers = TexelLayout::kSigned | TexelLayout::kFloat;
      sample.lower = std::bit_cast<std::uint32_t>(-1.0f);
      sample.upper = std::bit_cast<std::uint32_t>(1.0f);
    } else {
      sample.qualifiers = srgb && c == 3 ? TexelLayout::kLinear : std::uint8_t{0};
      sample.upper = 0xff;
    }
    layout.samples.push_back(sample);
  }
  return layout;
}

/// 4 x 4 texels whose bits are split evenly among `channels`.
TexelLayout block(VkFormat format, std::uint32_t bytes, std::uint8_t model,
                  const std::vector<std::uint8_t>& channels, bool srgb = false) {
  TexelLayout layout{format, 1, 4, bytes, model, srgb, {}};
  const auto bits = static_cast<std::uint16_t>(8 * bytes / channels.size());
  for (const std::uint8_t channel : channels) {
    Sample sample;
    sample.bit_offset = static_cast<std::uint16_t>(layout.samples.size() * bits);
    sample.bits = bits;
    sample.channel = channel;
    sample.upper = 0xffffffff;
    if (model == kModelBc6h) {
      sample.qualifiers = TexelLayout::kFloat;
      sample.upper = std::bit_cast<std::uint32_t>(1.0f);
    }
    layout.samples.push_back(sample);
  }
  return layout;
}

}  // namespace

const TexelLayout* find_texel_layout(VkFormat format) {
  static const std::array layouts{
      plain(VkFormat::r8_unorm, 1, 1, false, false),
      plain(VkFormat::rg8_unorm, 2, 1, false, false),
      plain(VkFormat::rgba8_unorm, 4, 1, false, false),
      plain(VkFormat::rgba8_srgb, 4, 1, true, false),
      plain(VkFormat::rgba16_sfloat, 4, 2, false, true),
      plain(VkFormat::rgba32_sfloat, 4, 4, false, true),
      block(VkFormat::bc1_rgb_unorm, 8, kModelBc1, {0}),
      block(VkFormat::bc3_unorm, 16, kModelBc3, {kAlpha, 0}),  // the alpha half of the block comes first
      block(VkFormat::bc4_unorm, 8, kModelBc4, {0}),
      block(VkFormat::bc5_unorm, 16, kModelBc5, {0, 1}),
      block(VkFormat::bc6h_ufloat, 16, kModelBc6h, {0}),
      block(VkFormat::bc7_unorm, 16, kModelBc7, {0}),
      block(VkFormat::bc7_srgb, 16, kModelBc7, {0}, true),
  };
  const auto found = std::ranges::find(layouts, format, &TexelLayout::format);
  return found == layouts.end() ? nullptr : &*found;
}

std::vector<std::uint32_t> data_format_descriptor(const TexelLayout& layout) {
  constexpr std::uint32_t kVersion = 2;
  constexpr std::uint32_t kBt709 = 1;
  const std::uint32_t transfer = layout.srgb ? 2 : 1;
  const auto block_size = static_cast<std::uint32_t>(24 + 16 * layout.samples.size());
  const std::uint32_t side = layout.block - 1;
  std::vector<std::uint32_t> words{
      4 + block_size,
      0,  // Khronos' basic descriptor
      kVersion | block_size << 16,
      layout.colour_model | kBt709 << 8 | transfer << 16,  // alpha is straight: no flags
      side | side << 8,
      layout.block_bytes,
      0,
  };
  for (const Sample& sample : layout.samples) {
    const auto channel_type = static_cast<std::uint32_t>(sample.channel | sample.qualifiers);
    words.push_back(sample.bit_offset | (sample.bits - 1u) << 16 | channel_type << 24);
    words.push_back(0);  // the sample's position in the block
    words.push_back(sample.lower);
    words.push_back(sample.upper);
  }
  return words;
}

}  // namespace sateen::io
