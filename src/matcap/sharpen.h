// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {

/// `map` as it would be under a filter whose variance is smaller by `variance` (radians^2): a shinier
/// material. Richardson-Lucy deconvolution on the sphere, regularised in two ways. It stops after
/// kSharpenRounds. And its multiplicative corrections are found on maps just fine enough for the filter, so
/// that they vary no faster than the filter is wide: grain finer than that keeps its contrast, where a
/// sharpening mask would raise it. Values stay >= 0.
SphereMap sharpened(const SphereMap& map, double variance);

inline constexpr int kSharpenRounds = 15;

}  // namespace sateen::matcap
