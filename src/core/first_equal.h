// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace sateen {

/// For each of `count` items the index of the first item equal to it (its own when it is new). `hash(i)`
/// gives a well-mixed 64-bit hash, equal(i, j) an equivalence. Linear time; 8 to 16 bytes of table per item.
template <class Hash, class Equal>
std::vector<std::uint32_t> first_equal(std::uint32_t count, const Hash& hash, const Equal& equal) {
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  const std::size_t slots = std::bit_ceil(std::size_t{2} * count + 1);
  std::vector<std::uint32_t> table(slots, kFree);
  std::vector<std::uint32_t> first(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::size_t slot = static_cast<std::size_t>(hash(i)) & (slots - 1);
    while (table[slot] != kFree && !equal(table[slot], i)) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kFree) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

/// Mixes a value into a hash (the finaliser of SplitMix64).
inline std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t value) {
  std::uint64_t z = hash + 0x9e3779b97f4a7c15u + value;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The bits of a float for hashing; the two zeros are equal numbers and get equal bits.
inline std::uint64_t hash_bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0f);
}

}  // namespace sateen
