// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sateen/render/frame.h"

namespace sateen {

/// Arbitrary output variables by name: "normal", "mesh_normal" (before any normal map), "tangent", "position"
/// (x, y, z in view space, as stored), "k" (tangent angle in turns), "mask" (1 where something was drawn at
/// the pixel's centre), "uv" (v up), "occlusion".
std::span<const std::string> aov_names();

/// One of them, taken at pixel centres, row 0 on top, 0 where nothing was drawn. Throws Error for an unknown
/// name. `frame.surfaces` must be there.
Image aov(const Frame& frame, const std::string& name);

}  // namespace sateen
