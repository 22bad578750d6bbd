// SPDX-License-Identifier: MIT
#include "sateen/amc/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/core/parallel.h"

namespace sateen::amc {
namespace {

constexpr int kMaxSize = 2048;  // what OpenGL implementations guarantee for 3D textures in practice
constexpr int kMaxSymmetry = 16;

/// The sRGB byte of every half, by its bits: encoding a table costs one look-up a channel.
const std::vector<std::byte>& srgb8_of_halves() {
  static const std::vector<std::byte> table = [] {
    std::vector<std::byte> t(65536);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const float linear = static_cast<float>(Eigen::numext::bit_cast<Half>(static_cast<std::uint16_t>(i)));
      const float clamped = linear > 0 ? std::min(linear, 1.0f) : 0.0f;  // NaN becomes black
      t[i] = static_cast<std::byte>(std::lround(255 * srgb_encode(clamped)));
    }
    return t;
  }();
  return table;
}

const std::array<Half, 256>& halves_of_srgb8() {
  static const std::array<Half, 256> table = [] {
    std::array<Half, 256> t;
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<Half>(srgb_decode(static_cast<float>(i) / 255));
    return t;
  }();
  return table;
}

}  // namespace

AmcTable::AmcTable(int size_, int slices_, int symmetry_)
    : size(size_), slices(slices_), symmetry(symmetry_) {
  if (size < 1 || size > kMaxSize || slices < 1 || slices > kMaxSize) {
    throw Error(fmt::format("an AMC of {0} x {0} x {1} texels is out of range; sizes go from 1 to {2}", size,
                            slices, kMaxSize));
  }
  if (symmetry < 1 || symmetry > kMaxSymmetry) {
    throw Error(
        fmt::format("an AMC's symmetry is a whole number from 1 to {}, not {}", kMaxSymmetry, symmetry));
  }
  texels.assign(index(0, 0, slices), Half(0));
  for (std::size_t i = 3; i < texels.size(); i += 4) texels[i] = Half(1);
}

Vec3f AmcTable::texel(int x, int y, int slice) const {
  const Half* t = texels.data() + index(x, y, slice);
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])};
}

void AmcTable::set_texel(int x, int y, int slice, const Vec3f& colour) {
  Half* t = texels.data() + index(x, y, slice);
  for (int c = 0; c < 3; ++c) t[c] = static_cast<Half>(colour[c]);
}

Image slice_image(const AmcTable& table, int slice) {
  Image image(table.size, table.size, 3);
  for (int y = 0; y < table.size; ++y) {
    for (int x = 0; x < table.size; ++x) image.set_rgb(x, table.size - 1 - y, table.texel(x, y, slice));
  }
  return image;
}

void set_slice_image(AmcTable& table, int slice, const Image& image) {
  for (int y = 0; y < table.size; ++y) {
    for (int x = 0; x < table.size; ++x) table.set_texel(x, y, slice, image.rgb(x, table.size - 1 - y));
  }
}

Image isotropic_average(const AmcTable& table) {
  Image mean(table.size, table.size, 3);
  parallel_for(table.size, [&](int y) {
    for (int x = 0; x < table.size; ++x) {
      Vec3 sum = Vec3::Zero();
      for (int f = 0; f < table.slices; ++f) sum += table.texel(x, y, f).cast<double>();
      mean.set_rgb(x, table.size - 1 - y, (sum / table.slices).cast<float>());
    }
  });
  return mean;
}

void quantise(AmcTable& table) {
  if (table.encoding == AmcEncoding::srgb8) set_encoded_texels(table, encoded_texels(table));
}

std::vector<std::byte> encoded_texels(const AmcTable& table) {
  if (table.encoding == AmcEncoding::half) {
    std::vector<std::byte> bytes(table.texels.size() * sizeof(Half));
    std::memcpy(bytes.data(), table.texels.data(), bytes.size());
    return bytes;
  }
  std::vector<std::byte> bytes(table.texels.size(), std::byte{255});
  const std::vector<std::byte>& srgb8 = srgb8_of_halves();
  parallel_for(table.slices, [&](int f) {
    for (std::size_t i = table.index(0, 0, f); i < table.index(0, 0, f + 1); ++i) {
      if (i % 4 != 3) bytes[i] = srgb8[Eigen::numext::bit_cast<std::uint16_t>(table.texels[i])];
    }
  });
  return bytes;
}

void set_encoded_texels(AmcTable& table, const std::vector<std::byte>& bytes) {
  if (table.encoding == AmcEncoding::half) {
    std::memcpy(table.texels.data(), bytes.data(),
                std::min(bytes.size(), table.texels.size() * sizeof(Half)));
    return;
  }
  const auto& halves = halves_of_srgb8();
  for (std::size_t i = 0; i < std::min(bytes.size(), table.texels.size()); ++i) {
    if (i % 4 != 3) table.texels[i] = halves[static_cast<std::size_t>(bytes[i])];
  }
}

}  // namespace sateen::amc
