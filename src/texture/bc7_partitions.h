// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sateen/texture/bc7_fit.h"

namespace sateen::bc7 {

/// The subset, 0 to subsets - 1, of a texel in one of the 64 shapes of two or three subsets.
std::size_t subset_of(int subsets, int partition, std::size_t texel);

/// 1 for the texels of a subset, 0 for the others.
const Plane& subset_plane(int subsets, int partition, int subset);

/// The texel of a subset whose index loses its top bit.
std::size_t anchor_of(int subsets, int partition, int subset);

/// A shape and the residual of the best line through each of its parts: a guess of what a mode can reach.
struct PartitionGuess {
  float residual = 0;
  int partition = 0;
};

/// The `best` shapes of the first `partitions` for these texels, sorted; `channels` of them count.
std::vector<PartitionGuess> guess_partitions(const Planes& texels, int channels, int subsets, int partitions,
                                             std::size_t best);

}  // namespace sateen::bc7
