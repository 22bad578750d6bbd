// SPDX-License-Identifier: MIT
#include "sateen/texture/block_compression.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sateen/texture/bc7_tables.h"
#include "support/files.h"
#include "texture/dds.h"

namespace sateen::texture {
namespace {

using Pixels = std::vector<std::uint8_t>;

Pixels encode_and_decode(BlockFormat format, const Pixels& rgba, int width, int height,
                         const Bc7Options& options = {}) {
  const test::TemporaryFolder folder;
  const auto blocks = compress_blocks(format, rgba, width, height, options);
  EXPECT_EQ(blocks.size(),
            block_bytes(format) * static_cast<std::size_t>((width + 3) / 4 * ((height + 3) / 4)));
  return test::decode_blocks(format, blocks, width, height, folder / "blocks.dds");
}

double psnr(const Pixels& a, const Pixels& b, std::size_t channels, std::size_t first = 0) {
  double sum = 0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); i += 4) {
    for (std::size_t c = first; c < first + channels; ++c)
      sum += std::pow(double(a[i + c]) - double(b[i + c]), 2);
  }
  const double mse = sum / (static_cast<double>(a.size() / 4) * static_cast<double>(channels));
  return 10 * std::log10(255 * 255 / std::max(mse, 1e-6));
}

/// Smooth colours with an edge, some noise and a varying alpha.
Pixels picture(int width, int height) {
  std::mt19937 generator(5);
  Pixels rgba;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = static_cast<double>(x) / width;
      const double v = static_cast<double>(y) / height;
      const double edge = u + 0.3 * std::sin(9 * v) > 0.5 ? 1 : 0;
      const double noise = static_cast<double>(generator() % 1000) / 1000 * 0.02;
      const double channels[4] = {0.2 + 0.5 * u + 0.2 * edge, 0.5 + 0.4 * std::sin(7 * u + 3 * v),
                                  0.8 - 0.6 * v * edge, 0.5 + 0.5 * std::cos(5 * v)};
      for (const double c : channels)
        rgba.push_back(static_cast<std::uint8_t>(std::clamp(c + noise, 0.0, 1.0) * 255));
    }
  }
  return rgba;
}

TEST(Bc7, ConstantBlocksAreExact) {
  Pixels rgba;
  for (int v = 0; v < 256; ++v) {
    for (int i = 0; i < 16; ++i) {
      for (const int c : {v, 255 - v, v / 2, 255 - v / 3}) rgba.push_back(static_cast<std::uint8_t>(c));
    }
  }
  // Blocks of 4 x 4 side by side in a column: each is 4 rows of 4.
  EXPECT_EQ(encode_and_decode(BlockFormat::bc7, rgba, 4, 4 * 256), rgba);
}

TEST(Bc7, EveryPartitionDecodesAsItWasMeant) {
  // Two unrelated lines of colour in the shape of each partition: only that partition can hold them.
  for (std::size_t p = 0; p < 64; ++p) {
    Pixels rgba(64);
    for (std::size_t i = 0; i < 16; ++i) {
      const bool second = ((bc7::kPartition2[p] >> i) & 1) != 0;
      const int t = static_cast<int>(i * 7 % 16) * 4;
      const int colour[4] = {second ? 200 - t : 20 + t, second ? 30 + t / 2 : 180 + t,
                             second ? 120 : 40 - t / 2, 255};
      for (std::size_t c = 0; c < 4; ++c) rgba[i * 4 + c] = static_cast<std::uint8_t>(colour[c]);
    }
    EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, 4, 4), 3), 38) << "partition " << p;
  }
}

TEST(Bc7, EveryPartitionOfThreeDecodesAsItWasMeant) {
  // Three colours far apart, each with a little line of its own: two lines are far from holding them.
  for (std::size_t p = 0; p < 64; ++p) {
    Pixels rgba(64);
    for (std::size_t i = 0; i < 16; ++i) {
      const auto part = (bc7::kPartition3[p] >> (2 * i)) & 3U;
      const int t = static_cast<int>(i * 7 % 16);
      const std::array<std::array<int, 3>, 3> colours = {
          {{230 - t, 40 + t, 30}, {30 + t, 220 - t, 60 + t}, {60, 50 + t, 235 - t}}};
      for (std::size_t c = 0; c < 3; ++c) rgba[i * 4 + c] = static_cast<std::uint8_t>(colours[part][c]);
      rgba[i * 4 + 3] = 255;
    }
    EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, 4, 4), 3), 36) << "partition " << p;
  }
}

TEST(Bc7, KeepsAlphaWhenItIsData) {
  const Pixels rgba = picture(64, 64);
  Bc7Options options;
  options.alpha = true;
  EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, 64, 64, options), 4), 38);
  // Opaque texels stay opaque.
  Pixels opaque = rgba;
  for (std::size_t i = 3; i < opaque.size(); i += 4) opaque[i] = 255;
  const Pixels decoded = encode_and_decode(BlockFormat::bc7, opaque, 64, 64, options);
  EXPECT_GT(psnr(opaque, decoded, 3), 38);
  EXPECT_GT(psnr(opaque, decoded, 1, 3), 55);
}

TEST(Bc7, MoreEffortIsNotWorseAndAllAreGood) {
  const Pixels rgba = picture(128, 128);
  double last = 0;
  for (const Bc7Effort effort : {Bc7Effort::fast, Bc7Effort::normal, Bc7Effort::best}) {
    Bc7Options options;
    options.effort = effort;
    const double quality = psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, 128, 128, options), 3);
    EXPECT_GT(quality, 40);
    EXPECT_GE(quality, last - 0.01);
    last = quality;
  }
}

TEST(Bc7, SurvivesNoise) {
  std::mt19937 generator(9);
  Pixels rgba(64 * 64 * 4);
  for (auto& v : rgba) v = static_cast<std::uint8_t>(generator() & 255);
  Bc7Options options;
  options.alpha = true;
  for (const Bc7Effort effort : {Bc7Effort::fast, Bc7Effort::normal, Bc7Effort::best}) {
    options.effort = effort;
    EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, 64, 64, options), 4), 12);
  }
}

TEST(Bc5, IsCloseAndExactAtTheEnds) {
  const Pixels rgba = picture(64, 64);
  EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc5, rgba, 64, 64), 2), 44);
  // 0 and 255 beside values of a narrow range: the six-level mode.
  Pixels block(64, 255);
  for (std::size_t i = 0; i < 16; ++i) {
    block[i * 4] = static_cast<std::uint8_t>(i == 3 ? 0 : i == 9 ? 255 : 100 + 2 * (i % 6));
    block[i * 4 + 1] = 77;
  }
  EXPECT_GT(psnr(block, encode_and_decode(BlockFormat::bc5, block, 4, 4), 2), 48);
}

TEST(Bc1AndBc3, AreReasonable) {
  const Pixels rgba = picture(64, 64);
  Pixels opaque = rgba;
  for (std::size_t i = 3; i < opaque.size(); i += 4) opaque[i] = 255;
  EXPECT_GT(psnr(opaque, encode_and_decode(BlockFormat::bc1, opaque, 64, 64), 3), 32);
  EXPECT_GT(psnr(opaque, encode_and_decode(BlockFormat::bc3, opaque, 64, 64), 4), 33);
}

TEST(CompressBlocks, WhatLiesBeyondTheEdgeIsTheEdge) {
  // Noise, and a last column of one colour that has the last block for itself.
  std::mt19937 generator(4);
  Pixels rgba(5 * 4 * 4);
  const Pixels colour{120, 30, 200, 255};
  for (std::size_t i = 0; i < rgba.size(); ++i)
    rgba[i] = i / 4 % 5 == 4 ? colour[i % 4] : static_cast<std::uint8_t>(generator() & 255);
  const Pixels decoded = encode_and_decode(BlockFormat::bc7, rgba, 5, 4);
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(decoded[(y * 5 + 4) * 4 + c], colour[c]) << y;
  }
}

TEST(CompressBlocks, SizesThatAreNoMultipleOfFour) {
  for (const auto& [w, h] : {std::pair{1, 1}, std::pair{5, 3}, std::pair{13, 7}, std::pair{2, 9}}) {
    Pixels rgba = picture(w, h);
    for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
    EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc7, rgba, w, h), 3), 25);
    EXPECT_GT(psnr(rgba, encode_and_decode(BlockFormat::bc5, rgba, w, h), 2), 25);
  }
}

}  // namespace
}  // namespace sateen::texture
