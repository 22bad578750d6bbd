// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sateen/io/ktx2.h"

namespace sateen::io {

/// How the texels of one format lie in memory and how Khronos' basic data format descriptor says so.
struct TexelLayout {
  /// One channel of a texel, or one part of a compressed block.
  struct Sample {
    std::uint16_t bit_offset = 0;
    std::uint16_t bits = 0;
    std::uint8_t channel = 0;  ///< of the colour model; for RGBSDA 0, 1, 2 are red, green, blue and 15 alpha
    std::uint8_t qualifiers = 0;  ///< kLinear, kSigned, kFloat
    std::uint32_t lower = 0;      ///< what stands for 0, or -1 when signed
    std::uint32_t upper = 0;      ///< what stands for 1
  };
  static constexpr std::uint8_t kLinear = 0x10;  ///< the sample does not follow the sRGB transfer function
  static constexpr std::uint8_t kSigned = 0x40;
  static constexpr std::uint8_t kFloat = 0x80;

  VkFormat format = VkFormat::rgba8_srgb;
  std::uint32_t type_size = 1;    ///< bytes of one number, for changing the byte order; 1 for blocks
  std::uint32_t block = 1;        ///< texels along each side of a block; 1: not compressed
  std::uint32_t block_bytes = 4;  ///< of one block or texel
  std::uint8_t colour_model = 1;  ///< KHR_DF_MODEL_*
  bool srgb = false;              ///< transfer function of the colour channels; otherwise linear
  std::vector<Sample> samples;    ///< in the order of their bit offsets
};

/// The layout of a format; nullptr for one Sateen does not know.
const TexelLayout* find_texel_layout(VkFormat format);

/// A whole descriptor: total size, then one basic descriptor block (Khronos Data Format 1.3, section 5).
/// bytesPlane0 is the size of a texel or block for supercompressed levels too: later editions of KTX 2.0 ask
/// for that, and readers that went by the first, which asked for 0, do not look.
std::vector<std::uint32_t> data_format_descriptor(const TexelLayout& layout);

}  // namespace sateen::io
