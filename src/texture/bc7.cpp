// SPDX-License-Identifier: MIT
#include "sateen/texture/bc7.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/texture/bc7_fit.h"
#include "sateen/texture/bc7_tables.h"

namespace sateen {
namespace {

using namespace bc7;

/// Writes fields from the lowest bit of a 128-bit block upwards.
class BitWriter {
 public:
  void put(int value, int bits) {
    for (int i = 0; i < bits; ++i, ++at_) {
      if (((value >> i) & 1) != 0)
        words_[static_cast<std::size_t>(at_ / 64)] |= std::uint64_t{1} << (at_ % 64);
    }
  }
  void store(std::span<std::byte, 16> out) const {
    for (std::size_t i = 0; i < 16; ++i)
      out[i] = static_cast<std::byte>((words_[i / 8] >> (i % 8 * 8)) & 0xff);
  }

 private:
  std::array<std::uint64_t, 2> words_{};
  int at_ = 0;
};

/// The anchor's top index bit is implied 0: turn the line around where it is 1.
void settle_anchor(SubsetCode& code, std::size_t anchor, int index_bits) {
  const int top = (1 << index_bits) - 1;
  if (code.index[anchor] <= top / 2) return;
  std::swap(code.ends.stored[0], code.ends.stored[1]);
  std::swap(code.ends.p[0], code.ends.p[1]);
  for (int& i : code.index) i = top - i;
}

/// 1 for the texels of a subset of a two-subset partition, 0 for the others.
const Plane& subset_plane(int partition, int subset) {
  static const auto kPlanes = [] {
    std::array<std::array<Plane, 2>, 64> planes{};
    for (std::size_t p = 0; p < 64; ++p) {
      for (std::size_t i = 0; i < 16; ++i) planes[p][(bc7::kPartition2[p] >> i) & 1][i] = 1;
    }
    return planes;
  }();
  return kPlanes[static_cast<std::size_t>(partition)][static_cast<std::size_t>(subset)];
}

/// A whole block in one of the modes, ready to be written.
struct BlockCode {
  int mode = -1;
  int partition = 0;
  int rotation = 0;
  int index_mode = 0;
  std::array<SubsetCode, 2> part;  ///< the subsets; in modes 4 and 5 colour and scalar
  float error = std::numeric_limits<float>::max();
};

constexpr SubsetFormat kMode1{0, 3, 6, PBits::shared, 3};
constexpr SubsetFormat kMode3{0, 3, 7, PBits::each, 2};
constexpr SubsetFormat kMode6{0, 4, 7, PBits::each, 4};
constexpr SubsetFormat kMode6Opaque{0, 3, 7, PBits::each, 4};
constexpr SubsetFormat kMode7{0, 4, 5, PBits::each, 2};

void try_mode6(const Planes& texels, bool alpha, bool thorough, BlockCode& best) {
  Plane all;
  all.fill(1);
  SubsetCode code = fit(texels, all, alpha ? kMode6 : kMode6Opaque, thorough);
  if (code.error >= best.error) return;
  if (!alpha) code.ends.stored[0][3] = code.ends.stored[1][3] = 127;
  best = {6, 0, 0, 0, {code, {}}, code.error};
}

/// Modes 4 and 5: one channel (`scalar`) has its own line and indices.
void try_rotation(const Planes& texels, bool alpha, int mode, int rotation, int index_mode, bool thorough,
                  BlockCode& best) {
  Planes turned = texels;
  if (rotation > 0) std::swap(turned[static_cast<std::size_t>(rotation - 1)], turned[3]);
  Plane all;
  all.fill(1);
  const int colour_index = mode == 5 ? 2 : index_mode == 0 ? 2 : 3;
  const int scalar_index = mode == 5 ? 2 : index_mode == 0 ? 3 : 2;
  const SubsetFormat colour{0, 3, mode == 5 ? 7 : 5, PBits::none, colour_index};
  const SubsetFormat scalar{3, 1, mode == 5 ? 8 : 6, PBits::none, scalar_index};
  // Without alpha the channel that was turned into its place is constant 255 and costs nothing.
  if (!alpha && rotation == 0) return;
  const SubsetCode c = fit(turned, all, colour, thorough);
  if (c.error >= best.error) return;
  const SubsetCode s = fit(turned, all, scalar, thorough);
  if (c.error + s.error < best.error) best = {mode, 0, rotation, index_mode, {c, s}, c.error + s.error};
}

/// Mode 5 holds any constant colour exactly: for each 8-bit value there are two 7-bit ends whose step at
/// 21/64 is it.
struct ConstantEnds {
  std::array<std::array<int, 2>, 256> stored{};
};

const ConstantEnds& constant_ends() {
  static const ConstantEnds kEnds = [] {
    ConstantEnds ends;
    for (int a = 0; a < 128; ++a) {
      for (int b = 0; b < 128; ++b) {
        const int value = (expand(a, 7) * (64 - 21) + expand(b, 7) * 21 + 32) >> 6;
        ends.stored[static_cast<std::size_t>(value)] = {a, b};
      }
    }
    return ends;
  }();
  return kEnds;
}

BlockCode constant_block(const std::array<std::uint8_t, 4>& texel) {
  BlockCode code;
  code.mode = 5;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t e = 0; e < 2; ++e) code.part[0].ends.stored[e][c] = constant_ends().stored[texel[c]][e];
  }
  code.part[0].index.fill(1);
  for (auto& end : code.part[1].ends.stored) end[3] = texel[3];
  return code;
}

/// Residual of the best line through each subset of every partition, sorted by it: a cheap guess of what a
/// two-subset mode can reach.
struct PartitionGuess {
  float residual;
  int partition;
};

std::array<PartitionGuess, 64> guess_partitions(const Planes& texels, int channels) {
  // Sums of the 14 monomials of degree 1 and 2 over the second subset; the first is the total less those.
  constexpr std::size_t kMost = 14;
  std::array<Plane, kMost> monomials{};
  std::size_t n = 0;
  const auto c_count = static_cast<std::size_t>(channels);
  for (std::size_t c = 0; c < c_count; ++c) monomials[n++] = texels[c];
  for (std::size_t a = 0; a < c_count; ++a) {
    for (std::size_t b = a; b < c_count; ++b) {
      for (std::size_t i = 0; i < 16; ++i) monomials[n][i] = texels[a][i] * texels[b][i];
      ++n;
    }
  }
  std::array<float, kMost> total{};
  for (std::size_t m = 0; m < n; ++m) {
    for (const float v : monomials[m]) total[m] += v;
  }
  const auto residual = [&](const std::array<float, kMost>& sums, float count) {
    std::array<std::array<float, 4>, 4> cov{};
    std::size_t at = c_count;
    float trace = 0;
    for (std::size_t a = 0; a < c_count; ++a) {
      for (std::size_t b = a; b < c_count; ++b) {
        cov[a][b] = cov[b][a] = sums[at++] - sums[a] * sums[b] / count;
      }
      trace += cov[a][a];
    }
    // The largest eigenvalue is at most the Frobenius norm, and close to it where one line fits.
    float squared = 0;
    for (const auto& row : cov) {
      for (const float v : row) squared += v * v;
    }
    return std::max(trace - std::sqrt(squared), 0.0f);
  };
  std::array<PartitionGuess, 64> guesses{};
  for (int partition = 0; partition < 64; ++partition) {
    const Plane& inside = subset_plane(partition, 1);
    float count = 0;
    for (const float w : inside) count += w;
    std::array<float, kMost> second{};
    std::array<float, kMost> first{};
    for (std::size_t m = 0; m < n; ++m) {
      float sum = 0;
      for (std::size_t i = 0; i < 16; ++i) sum += monomials[m][i] * inside[i];
      second[m] = sum;
      first[m] = total[m] - sum;
    }
    guesses[static_cast<std::size_t>(partition)] = {residual(first, 16 - count) + residual(second, count),
                                                    partition};
  }
  return guesses;
}

void try_two_subsets(const Planes& texels, int mode, const SubsetFormat& format, int partition, bool thorough,
                     BlockCode& best) {
  BlockCode code{mode, partition, 0, 0, {}, 0};
  for (int subset = 0; subset < 2; ++subset) {
    SubsetCode& part = code.part[static_cast<std::size_t>(subset)];
    part = fit(texels, subset_plane(partition, subset), format, thorough);
    code.error += part.error;
    if (code.error >= best.error) return;
  }
  best = code;
}

/// Endpoint channels in the specification's order: all of red, then green, blue, alpha.
void put_endpoints(BitWriter& bits, std::span<const SubsetCode> subsets, std::size_t first,
                   std::size_t channels, int width) {
  for (std::size_t c = first; c < first + channels; ++c) {
    for (const SubsetCode& subset : subsets) {
      for (const auto& end : subset.ends.stored) bits.put(end[c], width);
    }
  }
}

void put_indices(BitWriter& bits, const std::array<int, 16>& index, int width) {
  for (std::size_t i = 0; i < 16; ++i) bits.put(index[i], i == 0 ? width - 1 : width);
}

void write(BlockCode code, std::span<std::byte, 16> out) {
  BitWriter bits;
  bits.put(1 << code.mode, code.mode + 1);
  if (code.mode == 4 || code.mode == 5) {
    const int colour_index = code.mode == 5 || code.index_mode == 0 ? 2 : 3;
    const int scalar_index = code.mode == 5 || code.index_mode == 1 ? 2 : 3;
    settle_anchor(code.part[0], 0, colour_index);
    settle_anchor(code.part[1], 0, scalar_index);
    bits.put(code.rotation, 2);
    if (code.mode == 4) bits.put(code.index_mode, 1);
    put_endpoints(bits, std::span(code.part).first(1), 0, 3, code.mode == 5 ? 7 : 5);
    put_endpoints(bits, std::span(code.part).last(1), 3, 1, code.mode == 5 ? 8 : 6);
    // The two-bit indices come first.
    const bool colour_first = colour_index == 2;
    put_indices(bits, code.part[colour_first ? 0 : 1].index, 2);
    put_indices(bits, code.part[colour_first ? 1 : 0].index, colour_first ? scalar_index : colour_index);
  } else if (code.mode == 6) {
    settle_anchor(code.part[0], 0, 4);
    put_endpoints(bits, std::span(code.part).first(1), 0, 4, 7);
    bits.put(code.part[0].ends.p[0], 1);
    bits.put(code.part[0].ends.p[1], 1);
    put_indices(bits, code.part[0].index, 4);
  } else {
    const SubsetFormat& format = code.mode == 1 ? kMode1 : code.mode == 3 ? kMode3 : kMode7;
    const auto partition = static_cast<std::size_t>(code.partition);
    const std::size_t anchor = bc7::kAnchor2[partition];
    settle_anchor(code.part[0], 0, format.index_bits);
    settle_anchor(code.part[1], anchor, format.index_bits);
    bits.put(code.partition, 6);
    put_endpoints(bits, code.part, 0, static_cast<std::size_t>(format.channels), format.bits);
    for (const SubsetCode& part : code.part) {
      bits.put(part.ends.p[0], 1);
      if (format.p == PBits::each) bits.put(part.ends.p[1], 1);
    }
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t subset = (bc7::kPartition2[partition] >> i) & 1;
      const bool anchored = i == (subset == 0 ? 0 : anchor);
      bits.put(code.part[subset].index[i], anchored ? format.index_bits - 1 : format.index_bits);
    }
  }
  bits.store(out);
}

}  // namespace

void encode_bc7_block(const BlockRgba8& block, const Bc7Options& options, std::span<std::byte, 16> out) {
  if (std::ranges::all_of(block, [&](const auto& texel) { return texel == block[0]; })) {
    write(constant_block(block[0]), out);
    return;
  }
  Planes texels{};
  bool alpha = false;
  for (std::size_t i = 0; i < 16; ++i) {
    for (std::size_t c = 0; c < 4; ++c) texels[c][i] = block[i][c];
    if (!options.alpha) texels[3][i] = 255;
    alpha = alpha || (options.alpha && block[i][3] != 255);
  }
  // An opaque block whose alpha is data must decode to 255 exactly; mode 6 then fits four channels.
  const bool exact_alpha = options.alpha;
  // Where the mean squared error is below 1/2 (51 dB), other modes are not worth their time.
  const float enough = options.effort == Bc7Effort::best ? 0.0f : 24.0f;
  const auto good_enough = [&](const BlockCode& code) { return code.error <= enough; };
  const bool thorough = options.effort == Bc7Effort::best;

  BlockCode best;
  try_mode6(texels, exact_alpha, thorough, best);
  for (int rotation = exact_alpha ? 0 : 1; rotation < 4 && !good_enough(best); ++rotation) {
    try_rotation(texels, exact_alpha, 5, rotation, 0, thorough, best);
  }
  if (options.effort != Bc7Effort::fast && !good_enough(best)) {
    auto guesses = guess_partitions(texels, alpha ? 4 : 3);
    const std::size_t tries = options.effort == Bc7Effort::best ? 16 : 3;
    std::ranges::partial_sort(guesses, guesses.begin() + static_cast<std::ptrdiff_t>(tries), {},
                              &PartitionGuess::residual);
    for (std::size_t i = 0; i < tries && guesses[i].residual < best.error; ++i) {
      if (alpha) {
        try_two_subsets(texels, 7, kMode7, guesses[i].partition, thorough, best);
      } else {
        try_two_subsets(texels, 1, kMode1, guesses[i].partition, thorough, best);
        try_two_subsets(texels, 3, kMode3, guesses[i].partition, thorough, best);
      }
    }
  }
  if (options.effort == Bc7Effort::best && !good_enough(best)) {
    for (int rotation = 0; rotation < 4; ++rotation) {
      for (int index_mode = 0; index_mode < 2; ++index_mode) {
        try_rotation(texels, exact_alpha, 4, rotation, index_mode, thorough, best);
      }
    }
  }
  write(best, out);
}

}  // namespace sateen
