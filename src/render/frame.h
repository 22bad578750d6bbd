// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sateen/core/appearance.h"
#include "sateen/core/image.h"

namespace sateen {

/// What the pipeline knew at each pixel's centre; four channels a picture, all 0 where nothing was drawn.
struct SurfaceImages {
  Image position;          ///< x, y, z in view space, 1 + material
  Image normal;            ///< x, y, z in view space, occlusion
  Image tangent;           ///< x, y, z in view space, sign of the bitangent
  Image eye_normal;        ///< x, y, z in the eye frame, k
  Image uv_and_curvature;  ///< u, v, curvature, 1
  Image mesh_normal;       ///< x, y, z in view space, before any normal map, and the side: 1 front, -1 back
};

/// The first three channels of a pixel.
inline Vec3 xyz(const Image& picture, int x, int y) {
  return picture.rgb(x, y).cast<double>();
}

/// One rendered picture.
struct Frame {
  Image colour;  ///< RGBA, linear, associated alpha
  std::optional<SurfaceImages> surfaces;
  bool perspective = false;  ///< whether the eye is at the view space's origin, or infinitely far along +z
};

/// The surface point at a pixel's centre as the appearance's evaluate() takes it; nothing where nothing was
/// drawn. `frame.surfaces` must be there.
std::optional<Surface> surface_at(const Frame& frame, int x, int y);

}  // namespace sateen
