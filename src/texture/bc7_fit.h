// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

namespace sateen::bc7 {

// Channels of a block as four planes of 16 floats: every inner loop below runs over the 16 texels of one
// plane, which compilers turn into vector code.
using Plane = std::array<float, 16>;
using Planes = std::array<Plane, 4>;

/// Endpoints of one subset as the block stores them.
struct Endpoints {
  std::array<std::array<int, 4>, 2> stored{};   ///< without p-bit
  std::array<std::array<float, 4>, 2> value{};  ///< expanded to 8 bits
  std::array<int, 2> p{};
};

struct SubsetCode {
  Endpoints ends;
  std::array<int, 16> index{};
  float error = std::numeric_limits<float>::max();
};

enum class PBits { none, shared, each };

/// How a mode stores the endpoints and indices of a subset.
struct SubsetFormat {
  int first = 0;     ///< channel
  int channels = 3;  ///< from `first`
  int bits = 7;      ///< of a stored endpoint channel, without p-bit
  PBits p = PBits::none;
  int index_bits = 4;
};

/// A value of `bits` bits as a decoder expands it to 8.
constexpr int expand(int v, int bits) {
  const int high = v << (8 - bits);
  return high | (high >> bits);
}

/// Fits a line to the texels of a subset (`inside` is 1 for them, 0 for the others) as `format` can store it:
/// principal axis, then least squares for the chosen steps; `thorough` tries every p-bit and more rounds.
SubsetCode fit(const Planes& texels, const Plane& inside, const SubsetFormat& format, bool thorough);

}  // namespace sateen::bc7
