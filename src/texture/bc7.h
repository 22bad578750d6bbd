// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sateen::texture {

/// A 4 x 4 block of 8-bit RGBA, row by row.
using BlockRgba8 = std::array<std::array<std::uint8_t, 4>, 16>;

enum class Bc7Effort {
  fast,    ///< modes 6 and 5
  normal,  ///< and modes 1 and 3 (7 with alpha), two subsets, where the block needs them
  best,    ///< and mode 4, more partitions, all p-bits, down to the last bit
};

struct Bc7Options {
  Bc7Effort effort = Bc7Effort::normal;
  /// Whether alpha is data. Otherwise it decodes to 254 or 255 and costs no precision.
  bool alpha = false;
};

/// Encodes one block: the squared error over the channels, as it will decode, is the measure. Format: Khronos
/// Data Format Specification 1.3, "BPTC compressed texture formats". Pure; the same bytes on every machine
/// that rounds floats the IEEE way.
void encode_bc7_block(const BlockRgba8& block, const Bc7Options& options, std::span<std::byte, 16> out);

}  // namespace sateen::texture
