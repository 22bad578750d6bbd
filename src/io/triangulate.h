// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen::io {

/// Cuts a simple polygon, convex or not and nearly flat, into triangles that wind as it does, by clipping
/// ears. The indices are places in `corners`; n corners give n - 2 triangles (fewer than three give none). A
/// polygon that crosses itself is cut somehow.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3f> corners);

}  // namespace sateen::io
