// SPDX-License-Identifier: MIT
#include "sateen/texture/mip_rows.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace sateen::texture {
namespace {

using Row = MipRowFilter::Row;

constexpr MipKernel kKernels[] = {MipKernel::box, MipKernel::kaiser};
constexpr MipWrap kWraps[] = {MipWrap::repeat, MipWrap::clamp, MipWrap::mirror};

std::vector<Row> noise(int width, int height, int channels) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<Row> rows;
  for (int y = 0; y < height; ++y) {
    rows.push_back({y, std::vector<float>(static_cast<std::size_t>(width * channels))});
    for (float& v : rows.back().values) v = value(generator);
  }
  return rows;
}

/// Output rows sorted by y, whatever order they came in.
std::vector<Row> filtered(MipRowFilter& filter, const std::vector<Row>& rows, std::size_t batch) {
  std::vector<Row> out;
  for (std::size_t i = 0; i < rows.size(); i += batch) {
    const auto end = std::min(i + batch, rows.size());
    for (Row& row : filter.push({rows.begin() + static_cast<std::ptrdiff_t>(i),
                                 rows.begin() + static_cast<std::ptrdiff_t>(end)})) {
      out.push_back(std::move(row));
    }
  }
  std::ranges::sort(out, {}, &Row::y);
  return out;
}

TEST(MipTaps, SumToOneAndStayInside) {
  for (const MipKernel kernel : kKernels) {
    for (const MipWrap wrap : kWraps) {
      for (const int in : {1, 2, 3, 5, 7, 16, 33, 100}) {
        const int out = std::max(in / 2, 1);
        for (const MipTaps& taps : mip_taps(in, out, kernel, wrap)) {
          double sum = 0;
          for (const MipTap& tap : taps) {
            EXPECT_GE(tap.source, 0);
            EXPECT_LT(tap.source, in);
            sum += tap.weight;
          }
          EXPECT_NEAR(sum, 1, 1e-6);
        }
      }
    }
  }
}

TEST(MipTaps, WrapModesAreWhatPaddingGives) {
  // A line that is written out on both sides as the mode says, far enough for the kernel, needs no mode.
  constexpr int kIn = 16;
  const std::vector<float> line = noise(kIn, 1, 1)[0].values;
  const auto source = [](MipWrap wrap, int x) {
    if (wrap == MipWrap::clamp) return std::clamp(x, 0, kIn - 1);
    const int inside = (x + kIn) % kIn;
    return wrap == MipWrap::repeat || x == inside ? inside : kIn - 1 - inside;
  };
  const auto value = [](const MipTaps& taps, const std::vector<float>& values) {
    double sum = 0;
    for (const MipTap& tap : taps) sum += tap.weight * values[static_cast<std::size_t>(tap.source)];
    return sum;
  };
  for (const MipKernel kernel : kKernels) {
    for (const MipWrap wrap : kWraps) {
      std::vector<float> padded;
      for (int x = -kIn; x < 2 * kIn; ++x) padded.push_back(line[static_cast<std::size_t>(source(wrap, x))]);
      const auto wrapped = mip_taps(kIn, kIn / 2, kernel, wrap);
      const auto plain = mip_taps(3 * kIn, 3 * kIn / 2, kernel, MipWrap::clamp);
      for (std::size_t i = 0; i < wrapped.size(); ++i) {
        EXPECT_NEAR(value(wrapped[i], line), value(plain[i + kIn / 2], padded), 1e-6) << i;
      }
    }
  }
}

TEST(MipTaps, BoxCoversOddSizesExactly) {
  // 5 texels onto 2: each covers two and a half.
  const auto taps = mip_taps(5, 2, MipKernel::box, MipWrap::repeat);
  ASSERT_EQ(taps[0].size(), 3u);
  EXPECT_FLOAT_EQ(taps[0][0].weight, 0.4f);
  EXPECT_FLOAT_EQ(taps[0][1].weight, 0.4f);
  EXPECT_FLOAT_EQ(taps[0][2].weight, 0.2f);
  EXPECT_FLOAT_EQ(taps[1][0].weight, 0.2f);
}

TEST(MipTaps, KaiserPassesLowFrequenciesBetterThanBox) {
  // A wave of 6 texels becomes one of 3: how much of its height is left.
  const auto height = [](MipKernel kernel) {
    const int in = 96;
    const auto taps = mip_taps(in, in / 2, kernel, MipWrap::repeat);
    double sum = 0;
    for (const MipTaps& line : taps) {
      double value = 0;
      for (const MipTap& tap : line)
        value += tap.weight * std::sin(2 * 3.14159265358979 * (tap.source + 0.5) / 6);
      sum += value * value;
    }
    return std::sqrt(sum / (in / 2) * 2);
  };
  EXPECT_NEAR(height(MipKernel::box), std::cos(3.14159265358979 / 6), 1e-5);
  EXPECT_GT(height(MipKernel::kaiser), 0.93);
}

TEST(MipRowFilter, GivesTheSameForAnyOrderAndBatch) {
  for (const MipKernel kernel : kKernels) {
    for (const MipWrap wrap : kWraps) {
      std::vector<Row> rows = noise(13, 21, 2);
      MipRowFilter in_order(13, 21, 2, kernel, wrap, wrap);
      const auto expected = filtered(in_order, rows, 1);
      ASSERT_EQ(expected.size(), 10u);
      EXPECT_EQ(expected[0].values.size(), 6u * 2);
      std::ranges::shuffle(rows, std::mt19937(1));
      MipRowFilter shuffled(13, 21, 2, kernel, wrap, wrap);
      const auto got = filtered(shuffled, rows, 4);
      ASSERT_EQ(got.size(), expected.size());
      for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i].values, expected[i].values);
    }
  }
}

TEST(MipRowFilter, KeepsAPeriodicPictureInPlaceUnderRepeat) {
  // Shifting the input by two rows and columns shifts the output by one, across the border too.
  const int size = 16;
  const std::vector<Row> rows = noise(size, size, 1);
  std::vector<Row> moved = rows;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      moved[static_cast<std::size_t>((y + 2) % size)].values[static_cast<std::size_t>((x + 2) % size)] =
          rows[static_cast<std::size_t>(y)].values[static_cast<std::size_t>(x)];
    }
  }
  MipRowFilter a(size, size, 1, MipKernel::kaiser, MipWrap::repeat, MipWrap::repeat);
  MipRowFilter b(size, size, 1, MipKernel::kaiser, MipWrap::repeat, MipWrap::repeat);
  const auto from = filtered(a, rows, 3);
  const auto to = filtered(b, moved, 3);
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 0; x < 8; ++x) {
      EXPECT_NEAR(to[(y + 1) % 8].values[(x + 1) % 8], from[y].values[x], 1e-5);
    }
  }
}

TEST(MipRowFilter, HoldsAFewRowsOfATallPicture) {
  const int height = 3000;
  MipRowFilter filter(8, height, 1, MipKernel::kaiser, MipWrap::repeat, MipWrap::repeat);
  std::size_t most = 0;
  for (int y = 0; y < height; ++y) {
    filter.push({{y, std::vector<float>(8, 1.0f)}});
    most = std::max(most, filter.held_values());
  }
  EXPECT_LE(most, 24u * 4);
  EXPECT_EQ(filter.held_values(), 0u);
}

TEST(MipRowFilter, HandlesLinesAndSingleTexels) {
  MipRowFilter line(7, 1, 1, MipKernel::kaiser, MipWrap::clamp, MipWrap::repeat);
  const auto out = line.push({{0, std::vector<float>(7, 2.0f)}});
  ASSERT_EQ(out.size(), 1u);
  ASSERT_EQ(out[0].values.size(), 3u);
  for (const float v : out[0].values) EXPECT_NEAR(v, 2, 1e-5);
  EXPECT_EQ(mip_levels(1, 1), 1);
  EXPECT_EQ(mip_levels(745, 3), 10);
  EXPECT_EQ(mip_sizes(5, 4), (std::vector<int>{5, 2, 1, 1}));
}

}  // namespace
}  // namespace sateen::texture
