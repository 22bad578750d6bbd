// SPDX-License-Identifier: MIT
#include "sateen/io/checksum.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace sateen::io {

std::string checksum(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace sateen::io
