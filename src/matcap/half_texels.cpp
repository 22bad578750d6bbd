// SPDX-License-Identifier: MIT
#include "sateen/matcap/half_texels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "sateen/core/parallel.h"

namespace sateen::matcap {
namespace {

constexpr std::size_t kTexelBytes = 4 * sizeof(Half);

/// The layers of one level, in the file's order.
template <class Matcap>
auto layers_of(Matcap& matcap, std::size_t level) {
  auto& low = matcap[Part::low].map.levels[level];
  auto& high = matcap[Part::high].map.levels[level];
  return std::array{&low.front, &low.back, &high.front, &high.back};
}

}  // namespace

std::vector<std::vector<std::byte>> half_levels(const MatcapDecomposition& matcap) {
  const auto largest = static_cast<float>(std::numeric_limits<Half>::max());
  std::vector<std::vector<std::byte>> levels(matcap[Part::low].map.levels.size());
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const auto layers = layers_of(matcap, level);
    const int size = layers[0]->width;
    const std::size_t row_bytes = static_cast<std::size_t>(size) * kTexelBytes;
    levels[level].resize(layers.size() * static_cast<std::size_t>(size) * row_bytes);
    parallel_for(static_cast<int>(layers.size()) * size, [&](int i) {
      const Image& image = *layers[static_cast<std::size_t>(i / size)];
      std::vector<Half> row(static_cast<std::size_t>(size) * 4);
      for (int x = 0; x < size; ++x) {
        const Vec3f color = image.rgb(x, size - 1 - i % size);
        for (int c = 0; c < 3; ++c)
          row[static_cast<std::size_t>(4 * x + c)] = Half(std::clamp(color[c], -largest, largest));
        row[static_cast<std::size_t>(4 * x + 3)] = Half(1.0F);
      }
      std::memcpy(levels[level].data() + static_cast<std::size_t>(i) * row_bytes, row.data(), row_bytes);
    });
  }
  return levels;
}

void set_half_levels(MatcapDecomposition& matcap, int size, std::span<const std::vector<std::byte>> levels) {
  for (MatcapPart& part : matcap.parts) part.map.levels.clear();
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const int across = std::max(1, size >> level);
    for (MatcapPart& part : matcap.parts)
      part.map.levels.push_back({Image(across, across, 3), Image(across, across, 3)});
    const auto layers = layers_of(matcap, level);
    const std::size_t row_bytes = static_cast<std::size_t>(across) * kTexelBytes;
    parallel_for(static_cast<int>(layers.size()) * across, [&](int i) {
      Image& image = *layers[static_cast<std::size_t>(i / across)];
      std::vector<Half> row(static_cast<std::size_t>(across) * 4);
      std::memcpy(row.data(), levels[level].data() + static_cast<std::size_t>(i) * row_bytes, row_bytes);
      for (int x = 0; x < across; ++x) {
        const std::size_t at = static_cast<std::size_t>(4 * x);
        image.set_rgb(
            x, across - 1 - i % across,
            {static_cast<float>(row[at]), static_cast<float>(row[at + 1]), static_cast<float>(row[at + 2])});
      }
    });
  }
}

}  // namespace sateen::matcap
