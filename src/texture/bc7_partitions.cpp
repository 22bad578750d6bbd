// SPDX-License-Identifier: MIT
#include "sateen/texture/bc7_partitions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/texture/bc7_tables.h"

namespace sateen::bc7 {
namespace {

// The monomials of degree 1 and 2 in up to four channels.
constexpr std::size_t kMost = 14;
using Sums = std::array<float, kMost>;

/// Of the best line through texels with these sums.
float line_residual(const Sums& sums, float count, std::size_t channels) {
  std::array<std::array<float, 4>, 4> cov{};
  std::size_t at = channels;
  float trace = 0;
  for (std::size_t a = 0; a < channels; ++a) {
    for (std::size_t b = a; b < channels; ++b) cov[a][b] = cov[b][a] = sums[at++] - sums[a] * sums[b] / count;
    trace += cov[a][a];
  }
  // The largest eigenvalue is at most the Frobenius norm, and close to it where one line fits.
  float squared = 0;
  for (const auto& row : cov) {
    for (const float v : row) squared += v * v;
  }
  return std::max(trace - std::sqrt(squared), 0.0f);
}

}  // namespace

std::size_t subset_of(int subsets, int partition, std::size_t texel) {
  const auto p = static_cast<std::size_t>(partition);
  return subsets == 2 ? (kPartition2[p] >> texel) & 1U : (kPartition3[p] >> (2 * texel)) & 3U;
}

const Plane& subset_plane(int subsets, int partition, int subset) {
  static const auto kPlanes = [] {
    std::array<std::array<std::array<Plane, 3>, 64>, 2> planes{};
    for (int count = 2; count <= 3; ++count) {
      for (int p = 0; p < 64; ++p) {
        auto& shape = planes[static_cast<std::size_t>(count - 2)][static_cast<std::size_t>(p)];
        for (std::size_t i = 0; i < 16; ++i) shape[subset_of(count, p, i)][i] = 1;
      }
    }
    return planes;
  }();
  return kPlanes[static_cast<std::size_t>(subsets - 2)][static_cast<std::size_t>(partition)]
                [static_cast<std::size_t>(subset)];
}

std::size_t anchor_of(int subsets, int partition, int subset) {
  const auto p = static_cast<std::size_t>(partition);
  if (subset == 0) return 0;
  if (subsets == 2) return kAnchor2[p];
  return subset == 1 ? kAnchor3Second[p] : kAnchor3Third[p];
}

std::vector<PartitionGuess> guess_partitions(const Planes& texels, int channels, int subsets, int partitions,
                                             std::size_t best) {
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
  Sums total{};
  for (std::size_t m = 0; m < n; ++m) {
    for (const float v : monomials[m]) total[m] += v;
  }
  std::vector<PartitionGuess> guesses(static_cast<std::size_t>(partitions));
  for (int partition = 0; partition < partitions; ++partition) {
    // The first subset is the total less the others.
    Sums first = total;
    float first_count = 16;
    float residual = 0;
    for (int subset = 1; subset < subsets; ++subset) {
      const Plane& inside = subset_plane(subsets, partition, subset);
      float count = 0;
      for (const float w : inside) count += w;
      Sums sums{};
      for (std::size_t m = 0; m < n; ++m) {
        float sum = 0;
        for (std::size_t i = 0; i < 16; ++i) sum += monomials[m][i] * inside[i];
        sums[m] = sum;
        first[m] -= sum;
      }
      first_count -= count;
      residual += line_residual(sums, count, c_count);
    }
    guesses[static_cast<std::size_t>(partition)] = {residual + line_residual(first, first_count, c_count),
                                                    partition};
  }
  std::ranges::partial_sort(guesses, guesses.begin() + static_cast<std::ptrdiff_t>(best), {},
                            &PartitionGuess::residual);
  guesses.resize(best);
  return guesses;
}

}  // namespace sateen::bc7
