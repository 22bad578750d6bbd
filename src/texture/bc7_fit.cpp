// SPDX-License-Identifier: MIT
#include "sateen/texture/bc7_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sateen::bc7 {
namespace {

/// Nearest stored value of an 8-bit value, and what it expands to, for every p-bit.
struct QuantTable {
  std::array<std::uint8_t, 256> stored{};
  std::array<std::uint8_t, 256> value{};
};

QuantTable make_quant_table(int bits, bool has_p, int p) {
  QuantTable table;
  for (int v = 0; v < 256; ++v) {
    int best = 1 << 30;
    for (int q = 0; q < (1 << bits); ++q) {
      const int out = has_p ? expand((q << 1) | p, bits + 1) : expand(q, bits);
      if (std::abs(out - v) < best) {
        best = std::abs(out - v);
        table.stored[static_cast<std::size_t>(v)] = static_cast<std::uint8_t>(q);
        table.value[static_cast<std::size_t>(v)] = static_cast<std::uint8_t>(out);
      }
    }
  }
  return table;
}

const QuantTable& quant_table(int bits, PBits p_mode, int p) {
  struct Tables {
    std::array<std::array<QuantTable, 3>, 9> of;
    Tables() {
      for (int b = 4; b <= 8; ++b) {
        of[static_cast<std::size_t>(b)][0] = make_quant_table(b, false, 0);
        if (b == 8) continue;
        of[static_cast<std::size_t>(b)][1] = make_quant_table(b, true, 0);
        of[static_cast<std::size_t>(b)][2] = make_quant_table(b, true, 1);
      }
    }
  };
  static const Tables tables;
  return tables
      .of[static_cast<std::size_t>(bits)][p_mode == PBits::none ? 0 : static_cast<std::size_t>(1 + p)];
}

using RawEnds = std::array<std::array<float, 4>, 2>;

Endpoints quantised(const RawEnds& raw, const SubsetFormat& format, std::array<int, 2> p) {
  Endpoints ends;
  ends.p = p;
  for (std::size_t e = 0; e < 2; ++e) {
    const QuantTable& table = quant_table(format.bits, format.p, p[e]);
    for (int c = 0; c < format.channels; ++c) {
      const std::size_t k = static_cast<std::size_t>(format.first + c);
      const auto v = static_cast<std::size_t>(std::clamp(raw[e][k] + 0.5f, 0.0f, 255.0f));
      ends.stored[e][k] = table.stored[v];
      ends.value[e][k] = table.value[v];
    }
  }
  return ends;
}

/// Squared error of the subset (weights 1 inside, 0 outside) with the best index of every texel.
SubsetCode coded(const Planes& texels, const Plane& inside, const SubsetFormat& format,
                 const Endpoints& ends) {
  SubsetCode code;
  code.ends = ends;
  const float top = static_cast<float>((1 << format.index_bits) - 1);
  float length = 0;
  for (int c = 0; c < format.channels; ++c) {
    const std::size_t k = static_cast<std::size_t>(format.first + c);
    const float d = ends.value[1][k] - ends.value[0][k];
    length += d * d;
  }
  Plane t{};
  if (length > 0) {
    const float scale = top / length;
    for (int c = 0; c < format.channels; ++c) {
      const std::size_t k = static_cast<std::size_t>(format.first + c);
      const float d = (ends.value[1][k] - ends.value[0][k]) * scale;
      const float e0 = ends.value[0][k];
      for (std::size_t i = 0; i < 16; ++i) t[i] += (texels[k][i] - e0) * d;
    }
  }
  Plane weight{};
  for (std::size_t i = 0; i < 16; ++i) {
    const float clamped = std::min(std::max(t[i], 0.0f), top);
    code.index[i] = static_cast<int>(clamped + 0.5f);
    weight[i] = static_cast<float>(static_cast<int>(static_cast<float>(code.index[i]) * (64 / top) + 0.5f));
  }
  Plane error{};
  for (int c = 0; c < format.channels; ++c) {
    const std::size_t k = static_cast<std::size_t>(format.first + c);
    const float e0 = ends.value[0][k];
    const float d = ends.value[1][k] - e0;
    for (std::size_t i = 0; i < 16; ++i) {
      const float value = static_cast<float>(static_cast<int>(e0 + (d * weight[i] + 32) * (1.0f / 64)));
      const float diff = value - texels[k][i];
      error[i] += diff * diff;
    }
  }
  code.error = 0;
  for (std::size_t i = 0; i < 16; ++i) code.error += error[i] * inside[i];
  return code;
}

/// Ends of the principal line through the subset.
RawEnds principal_line(const Planes& texels, const Plane& inside, const SubsetFormat& format) {
  float count = 0;
  for (const float w : inside) count += w;
  std::array<float, 4> mean{};
  std::array<std::array<float, 4>, 4> cov{};
  const auto channel = [&](int c) { return static_cast<std::size_t>(format.first + c); };
  Planes centred{};
  for (int c = 0; c < format.channels; ++c) {
    const std::size_t k = channel(c);
    float sum = 0;
    for (std::size_t i = 0; i < 16; ++i) sum += texels[k][i] * inside[i];
    mean[k] = sum / count;
    for (std::size_t i = 0; i < 16; ++i) centred[k][i] = (texels[k][i] - mean[k]) * inside[i];
  }
  std::array<float, 4> axis{};
  for (int a = 0; a < format.channels; ++a) {
    for (int b = a; b < format.channels; ++b) {
      float sum = 0;
      for (std::size_t i = 0; i < 16; ++i) sum += centred[channel(a)][i] * centred[channel(b)][i];
      cov[channel(a)][channel(b)] = cov[channel(b)][channel(a)] = sum;
    }
  }
  // Power iteration from the row of the largest variance: the error of a slightly wrong axis is of second
  // order.
  int widest = 0;
  for (int c = 1; c < format.channels; ++c) {
    if (cov[channel(c)][channel(c)] > cov[channel(widest)][channel(widest)]) widest = c;
  }
  axis = cov[channel(widest)];
  for (int step = 0; step < 6; ++step) {
    std::array<float, 4> next{};
    float largest = 0;
    for (int a = 0; a < format.channels; ++a) {
      for (int b = 0; b < format.channels; ++b)
        next[channel(a)] += cov[channel(a)][channel(b)] * axis[channel(b)];
      largest = std::max(largest, std::abs(next[channel(a)]));
    }
    if (!(largest > 0)) break;
    for (float& v : next) v /= largest;
    axis = next;
  }
  float squared = 0;
  for (const float v : axis) squared += v * v;
  float low = 0;
  float high = 0;
  if (squared > 0) {
    Plane t{};
    for (int c = 0; c < format.channels; ++c) {
      for (std::size_t i = 0; i < 16; ++i) t[i] += centred[channel(c)][i] * axis[channel(c)];
    }
    low = *std::ranges::min_element(t) / squared;
    high = *std::ranges::max_element(t) / squared;
  }
  RawEnds ends{};
  for (int c = 0; c < format.channels; ++c) {
    const std::size_t k = channel(c);
    ends[0][k] = mean[k] + low * axis[k];
    ends[1][k] = mean[k] + high * axis[k];
  }
  return ends;
}

/// Least-squares endpoints for given indices; false when all indices agree.
bool refit(const Planes& texels, const Plane& inside, const SubsetFormat& format, const SubsetCode& code,
           RawEnds& ends) {
  const float top = static_cast<float>((1 << format.index_bits) - 1);
  float aa = 0;
  float ab = 0;
  float bb = 0;
  Plane a{};
  Plane b{};
  for (std::size_t i = 0; i < 16; ++i) {
    const float t = static_cast<float>(code.index[i]) / top;
    a[i] = (1 - t) * inside[i];
    b[i] = t * inside[i];
    aa += a[i] * a[i];
    ab += a[i] * b[i];
    bb += b[i] * b[i];
  }
  const float det = aa * bb - ab * ab;
  if (!(det > 1e-4f)) return false;
  for (int c = 0; c < format.channels; ++c) {
    const std::size_t k = static_cast<std::size_t>(format.first + c);
    float ax = 0;
    float bx = 0;
    for (std::size_t i = 0; i < 16; ++i) {
      ax += a[i] * texels[k][i];
      bx += b[i] * texels[k][i];
    }
    ends[0][k] = (ax * bb - bx * ab) / det;
    ends[1][k] = (bx * aa - ax * ab) / det;
  }
  return true;
}

/// Squared change of one end by quantisation with a p-bit.
float quantisation_error(const std::array<float, 4>& end, const SubsetFormat& format, int p) {
  const QuantTable& table = quant_table(format.bits, format.p, p);
  float sum = 0;
  for (int c = 0; c < format.channels; ++c) {
    const float v = std::clamp(end[static_cast<std::size_t>(format.first + c)], 0.0f, 255.0f);
    const float d = static_cast<float>(table.value[static_cast<std::size_t>(v + 0.5f)]) - v;
    sum += d * d;
  }
  return sum;
}

/// The p-bits that move the ends least.
std::array<int, 2> nearest_p(const RawEnds& raw, const SubsetFormat& format) {
  if (format.p == PBits::none) return {0, 0};
  const auto error = [&](std::size_t e, int p) { return quantisation_error(raw[e], format, p); };
  if (format.p == PBits::shared) {
    const int p = error(0, 1) + error(1, 1) < error(0, 0) + error(1, 0) ? 1 : 0;
    return {p, p};
  }
  return {error(0, 1) < error(0, 0) ? 1 : 0, error(1, 1) < error(1, 0) ? 1 : 0};
}

/// Codes the subset with the likeliest p-bits, or with all, and keeps the best.
void keep_best(const Planes& texels, const Plane& inside, const SubsetFormat& format, const RawEnds& raw,
               bool all_p, SubsetCode& best) {
  const auto attempt = [&](std::array<int, 2> p) {
    const SubsetCode code = coded(texels, inside, format, quantised(raw, format, p));
    if (code.error < best.error) best = code;
  };
  if (!all_p || format.p == PBits::none) {
    attempt(nearest_p(raw, format));
  } else if (format.p == PBits::shared) {
    for (const int p : {0, 1}) attempt({p, p});
  } else {
    for (const int p : {0, 1, 2, 3}) attempt({p & 1, p >> 1});
  }
}

}  // namespace

SubsetCode fit(const Planes& texels, const Plane& inside, const SubsetFormat& format, bool thorough) {
  const int refinements = thorough ? 4 : 2;
  SubsetCode best;
  RawEnds raw = principal_line(texels, inside, format);
  keep_best(texels, inside, format, raw, thorough, best);
  for (int i = 0; i < refinements && best.error > 0; ++i) {
    const float before = best.error;
    if (!refit(texels, inside, format, best, raw)) break;
    keep_best(texels, inside, format, raw, thorough, best);
    if (best.error >= before) break;
  }
  return best;
}

}  // namespace sateen::bc7
