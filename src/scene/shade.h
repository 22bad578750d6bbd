// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/appearance/appearance.h"
#include "sateen/core/image.h"
#include "sateen/core/progress.h"

namespace sateen::scene {

/// Pictures of a surface, all of one size, row 0 on top; what is not there is empty.
struct ShadeInputs {
  Image normals = {};   ///< x, y, z in view space, any length; a zero vector (or less than 3 channels' worth)
                        ///< is empty
  Image tangents = {};  ///< x, y, z in view space, any length; zero is empty too
  Image positions =
      {};  ///< x, y, z in view space, the eye at the origin; without them the view is +z everywhere
  Image occlusion = {};  ///< first channel
  Image uvs = {};        ///< u, v
  Image curvature = {};  ///< first channel, 1 / view-space unit
  Image mesh_normals =
      {};  ///< normals before any normal map, as `normals`; empty, or zero in a pixel: the same
};

/// Shades every pixel with the appearance's C++ evaluator, no rasteriser involved, in parallel. RGBA, linear;
/// empty pixels are 0. Throws Error when sizes differ, normals or tangents have fewer than 3 channels, or the
/// appearance needs what is not there.
Image shade(const appearance::Appearance& appearance, const ShadeInputs& inputs,
            const Progress& progress = {});

}  // namespace sateen::scene
