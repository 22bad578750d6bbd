// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sateen/appearance/surface.h"
#include "sateen/core/image.h"

namespace sateen::scene {

/// What the pipeline knew at each pixel's centre; four channels a picture, all 0 where nothing was drawn.
struct SurfaceImages {
  Image position;            ///< x, y, z in view space, 1 + material
  Image normal;              ///< x, y, z in view space, occlusion
  Image tangent;             ///< x, y, z in view space, sign of the bitangent
  Image eye_normal;          ///< x, y, z in the eye frame, k
  Image uv_and_curvature;    ///< u, v, curvature, 1
  Image mesh_normal;         ///< x, y, z in view space, before any normal map, and the side: 1 front, -1 back
  bool perspective = false;  ///< whether the eye is at the view space's origin, or infinitely far along +z
};

/// The first three channels of a pixel.
inline Vec3 xyz(const Image& picture, int x, int y) {
  return picture.rgb(x, y).cast<double>();
}

/// The surface point at a pixel's centre as the appearance's evaluate() takes it; nothing where nothing was
/// drawn.
std::optional<appearance::Surface> surface_at(const SurfaceImages& images, int x, int y);

}  // namespace sateen::scene
