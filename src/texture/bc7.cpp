// SPDX-License-Identifier: MIT
#include "sateen/texture/bc7.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/texture/bc7_fit.h"
#include "sateen/texture/bc7_partitions.h"
#include "sateen/texture/bc7_tables.h"

namespace sateen::texture {
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

/// A whole block in one of the modes, ready to be written.
struct BlockCode {
  int mode = -1;
  int partition = 0;
  int rotation = 0;
  int index_mode = 0;
  std::array<SubsetCode, 3> part;  ///< the subsets; in modes 4 and 5 colour and scalar
  float error = std::numeric_limits<float>::max();
};

/// A mode whose texels lie in two or three subsets with lines of their own.
struct PartitionedMode {
  int mode;
  int subsets;
  int partition_bits;
  SubsetFormat format;
};

constexpr PartitionedMode kMode0{0, 3, 4, {0, 3, 4, PBits::each, 3}};
constexpr PartitionedMode kMode1{1, 2, 6, {0, 3, 6, PBits::shared, 3}};
constexpr PartitionedMode kMode2{2, 3, 6, {0, 3, 5, PBits::none, 2}};
constexpr PartitionedMode kMode3{3, 2, 6, {0, 3, 7, PBits::each, 2}};
constexpr PartitionedMode kMode7{7, 2, 6, {0, 4, 5, PBits::each, 2}};
constexpr SubsetFormat kMode6{0, 4, 7, PBits::each, 4};
constexpr SubsetFormat kMode6Opaque{0, 3, 7, PBits::each, 4};

const PartitionedMode& partitioned(int mode) {
  for (const PartitionedMode* candidate : {&kMode0, &kMode1, &kMode2, &kMode3}) {
    if (candidate->mode == mode) return *candidate;
  }
  return kMode7;
}

void try_mode6(const Planes& texels, bool alpha, bool thorough, BlockCode& best) {
  Plane all;
  all.fill(1);
  SubsetCode code = fit(texels, all, alpha ? kMode6 : kMode6Opaque, thorough);
  if (code.error >= best.error) return;
  if (!alpha) code.ends.stored[0][3] = code.ends.stored[1][3] = 127;
  best = {6, 0, 0, 0, {code, {}, {}}, code.error};
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
  if (c.error + s.error < best.error) best = {mode, 0, rotation, index_mode, {c, s, {}}, c.error + s.error};
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

void try_partition(const Planes& texels, const PartitionedMode& mode, int partition, bool thorough,
                   BlockCode& best) {
  BlockCode code{mode.mode, partition, 0, 0, {}, 0};
  for (int subset = 0; subset < mode.subsets; ++subset) {
    SubsetCode& part = code.part[static_cast<std::size_t>(subset)];
    part = fit(texels, subset_plane(mode.subsets, partition, subset), mode.format, thorough);
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
    put_endpoints(bits, std::span(code.part).subspan(1, 1), 3, 1, code.mode == 5 ? 8 : 6);
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
    const PartitionedMode& mode = partitioned(code.mode);
    const auto parts = std::span(code.part).first(static_cast<std::size_t>(mode.subsets));
    for (int subset = 0; subset < mode.subsets; ++subset) {
      settle_anchor(parts[static_cast<std::size_t>(subset)], anchor_of(mode.subsets, code.partition, subset),
                    mode.format.index_bits);
    }
    bits.put(code.partition, mode.partition_bits);
    put_endpoints(bits, parts, 0, static_cast<std::size_t>(mode.format.channels), mode.format.bits);
    for (const SubsetCode& part : parts) {
      if (mode.format.p != PBits::none) bits.put(part.ends.p[0], 1);
      if (mode.format.p == PBits::each) bits.put(part.ends.p[1], 1);
    }
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t subset = subset_of(mode.subsets, code.partition, i);
      const bool anchored = i == anchor_of(mode.subsets, code.partition, static_cast<int>(subset));
      bits.put(parts[subset].index[i], mode.format.index_bits - (anchored ? 1 : 0));
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
    const std::size_t tries = thorough ? 16 : 3;
    const auto try_shapes = [&](int subsets, int partitions, std::initializer_list<PartitionedMode> modes) {
      const int channels = alpha ? 4 : 3;
      for (const PartitionGuess& guess : guess_partitions(texels, channels, subsets, partitions, tries)) {
        if (guess.residual >= best.error) return;
        for (const PartitionedMode& mode : modes)
          try_partition(texels, mode, guess.partition, thorough, best);
      }
    };
    if (alpha) {
      try_shapes(2, 64, {kMode7});
    } else {
      try_shapes(2, 64, {kMode1, kMode3});
      // Three lines have coarse ends or few steps: they pay where two are far off (mean squared error above
      // 2).
      const float coarse = thorough ? 0.0f : 96.0f;
      if (best.error > coarse) try_shapes(3, 64, {kMode2});
      if (best.error > coarse) try_shapes(3, 16, {kMode0});
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

}  // namespace sateen::texture
