// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace sateen::io {

/// 32 hexadecimal digits that tell whether two byte sequences are equal but for malice: XXH3, 128 bits.
std::string checksum(std::span<const std::byte> bytes);

}  // namespace sateen::io
