// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sateen/matcap/decomposition.h"

namespace sateen::matcap {

/// The sphere maps as the GPU and the file take them: a level after the other, each with the layers low
/// front, low back, high front, high back, rows from v = 0 up, RGBA half floats with alpha 1. Values beyond
/// the range of half floats are clamped to it.
std::vector<std::vector<std::byte>> half_levels(const MatcapDecomposition& matcap);

/// Reads them back; `size` texels across level 0.
void set_half_levels(MatcapDecomposition& matcap, int size, std::span<const std::vector<std::byte>> levels);

}  // namespace sateen::matcap
