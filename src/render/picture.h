// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sateen/core/image.h"
#include "sateen/scene/surface_images.h"

namespace sateen::render {

/// One rendered picture.
struct Picture {
  Image colour;  ///< RGBA, linear, associated alpha
  std::optional<scene::SurfaceImages> surfaces;
};

}  // namespace sateen::render
