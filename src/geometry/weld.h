// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::geometry {

/// A hash of the exact coordinates; the two zeros count as one.
std::uint64_t position_hash(const Vec3f& position);

/// For each position the index of the first one with exactly the same coordinates: the vertices a UV or
/// normal seam has split share one index.
std::vector<std::uint32_t> weld_positions(std::span<const Vec3f> positions);

}  // namespace sateen::geometry
