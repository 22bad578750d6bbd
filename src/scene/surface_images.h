// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sateen/appearance/surface.h"
#include "sateen/core/image.h"

namespace sateen::scene {

/// What the surface pass knew at each pixel's centre: the packed Surface in pictures of four channels, all 0
/// where nothing was drawn.
struct SurfaceImages {
  std::vector<Image> packed;  ///< component i of a packed surface is channel i % 4 of picture i / 4
  bool perspective = false;   ///< whether the eye is at the view space's origin, or infinitely far along +z
};

/// The first three channels of a pixel.
inline Vec3 xyz(const Image& picture, int x, int y) {
  return picture.rgb(x, y).cast<double>();
}

/// The pictures that hold a packed surface.
int packed_pictures();

/// The surface point at a pixel's centre as an appearance takes it; nothing where nothing was drawn.
std::optional<appearance::Surface> surface_at(const SurfaceImages& images, int x, int y);

/// Arbitrary output variables by name, as surface_fields.h has them.
std::span<const std::string> aov_names();

/// One of them, taken at pixel centres, row 0 on top, 0 where nothing was drawn. Throws Error for an unknown
/// name.
Image aov(const SurfaceImages& images, const std::string& name);

}  // namespace sateen::scene
