// SPDX-License-Identifier: MIT
#include "sateen/texture/bc5.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sateen::texture {
namespace {

using Values = std::array<float, 16>;

struct Bc4Code {
  int end0 = 0;
  int end1 = 0;
  std::array<int, 16> index{};
  float error = std::numeric_limits<float>::max();
};

/// Codes with ends as they are: end0 > end1 means eight levels between them, otherwise six and 0 and 255.
/// Decoders interpolate exactly or to 8 bits; exact values are the middle way.
void try_ends(const Values& values, int end0, int end1, Bc4Code& best) {
  Bc4Code code{end0, end1, {}, 0};
  const bool eight = end0 > end1;
  const float steps = eight ? 7.0f : 5.0f;
  const float e0 = static_cast<float>(end0);
  const float d = static_cast<float>(end1 - end0);
  const float scale = end0 == end1 ? 0 : steps / d;
  Values error{};
  for (std::size_t i = 0; i < 16; ++i) {
    const float t = std::min(std::max((values[i] - e0) * scale, 0.0f), steps);
    const int step = static_cast<int>(t + 0.5f);
    const float value = e0 + d * static_cast<float>(step) / steps;
    error[i] = (value - values[i]) * (value - values[i]);
    // Index 0 and 1 are the ends; those between follow.
    code.index[i] = step == 0 ? 0 : step == static_cast<int>(steps) ? 1 : step + 1;
  }
  if (!eight) {
    for (std::size_t i = 0; i < 16; ++i) {
      const float black = values[i] * values[i];
      const float white = (255 - values[i]) * (255 - values[i]);
      if (black < error[i]) {
        error[i] = black;
        code.index[i] = 6;
      }
      if (white < error[i]) {
        error[i] = white;
        code.index[i] = 7;
      }
    }
  }
  for (const float e : error) code.error += e;
  if (code.error < best.error) best = code;
}

/// Least-squares ends for the steps the best code has chosen.
void refine(const Values& values, Bc4Code& best) {
  const bool eight = best.end0 > best.end1;
  const float steps = eight ? 7.0f : 5.0f;
  float aa = 0;
  float ab = 0;
  float bb = 0;
  float ax = 0;
  float bx = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    const int index = best.index[i];
    if (!eight && index >= 6) continue;
    const float t = index == 0 ? 0 : index == 1 ? 1 : static_cast<float>(index - 1) / steps;
    aa += (1 - t) * (1 - t);
    ab += (1 - t) * t;
    bb += t * t;
    ax += (1 - t) * values[i];
    bx += t * values[i];
  }
  const float det = aa * bb - ab * ab;
  if (!(det > 1e-4f)) return;
  const auto rounded = [](float v) { return static_cast<int>(std::clamp(v + 0.5f, 0.0f, 255.0f)); };
  const int end0 = rounded((ax * bb - bx * ab) / det);
  const int end1 = rounded((bx * aa - ax * ab) / det);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const int a = std::clamp(end0 + i, 0, 255);
      const int b = std::clamp(end1 + j, 0, 255);
      if ((a > b) == eight) try_ends(values, a, b, best);
    }
  }
}

}  // namespace

void encode_bc4_block(std::span<const std::uint8_t, 16> bytes, std::span<std::byte, 8> out) {
  Values values{};
  std::ranges::transform(bytes, values.begin(), [](std::uint8_t v) { return static_cast<float>(v); });
  const auto [low, high] = std::ranges::minmax(bytes);
  Bc4Code best;
  if (low == high) {
    best = {high, low, {}, 0};
  } else {
    // The range, and the range drawn in by half a step, where most of the values are better served.
    for (const int inset : {0, (high - low) / 32, (high - low) / 16}) {
      if (high - inset > low + inset) try_ends(values, high - inset, low + inset, best);
    }
    refine(values, best);
    if (low == 0 || high == 255) {
      int inner_low = 255;
      int inner_high = 0;
      for (const std::uint8_t v : bytes) {
        if (v > 0 && v < 255) {
          inner_low = std::min<int>(inner_low, v);
          inner_high = std::max<int>(inner_high, v);
        }
      }
      Bc4Code six;
      try_ends(values, std::min(inner_low, inner_high), std::max(inner_low, inner_high), six);
      refine(values, six);
      if (six.error < best.error) best = six;
    }
  }
  std::uint64_t bits = static_cast<std::uint64_t>(best.end0) | static_cast<std::uint64_t>(best.end1) << 8;
  for (std::size_t i = 0; i < 16; ++i) bits |= static_cast<std::uint64_t>(best.index[i]) << (16 + 3 * i);
  for (std::size_t i = 0; i < 8; ++i) out[i] = static_cast<std::byte>((bits >> (8 * i)) & 0xff);
}

void encode_bc5_block(const BlockRgba8& block, std::span<std::byte, 16> out) {
  std::array<std::uint8_t, 16> values{};
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < 16; ++i) values[i] = block[i][c];
    encode_bc4_block(values, std::span<std::byte, 8>(out.data() + 8 * c, 8));
  }
}

}  // namespace sateen::texture
