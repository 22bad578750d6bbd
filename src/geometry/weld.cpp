// SPDX-License-Identifier: MIT
#include "sateen/geometry/weld.h"

#include "sateen/core/first_equal.h"

namespace sateen::geometry {

std::uint64_t position_hash(const Vec3f& position) {
  return mix_hash(mix_hash(mix_hash(0, hash_bits(position.x())), hash_bits(position.y())),
                  hash_bits(position.z()));
}

std::vector<std::uint32_t> weld_positions(std::span<const Vec3f> positions) {
  return first_equal(
      static_cast<std::uint32_t>(positions.size()),
      [&](std::uint32_t i) { return position_hash(positions[i]); },
      [&](std::uint32_t i, std::uint32_t j) { return positions[i] == positions[j]; });
}

}  // namespace sateen::geometry
