// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sateen/scene/surface_images.h"

namespace sateen::scene {

/// Arbitrary output variables by name: "normal", "mesh_normal" (before any normal map), "tangent", "position"
/// (x, y, z in view space, as stored), "k" (tangent angle in turns), "mask" (1 where something was drawn at
/// the pixel's centre), "uv" (v up), "occlusion".
std::span<const std::string> aov_names();

/// One of them, taken at pixel centres, row 0 on top, 0 where nothing was drawn. Throws Error for an unknown
/// name.
Image aov(const SurfaceImages& surfaces, const std::string& name);

}  // namespace sateen::scene
