// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sateen/texture/bc7.h"

namespace sateen::texture {

/// Encodes one channel of 16 texels into a BC4 block (8 bytes): both of the format's modes, ends refined
/// around the range and by least squares, exact integer arithmetic of the format.
void encode_bc4_block(std::span<const std::uint8_t, 16> values, std::span<std::byte, 8> out);

/// Red and green of a block as two BC4 blocks.
void encode_bc5_block(const BlockRgba8& block, std::span<std::byte, 16> out);

}  // namespace sateen::texture
