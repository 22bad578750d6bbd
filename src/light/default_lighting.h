// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/image.h"
#include "sateen/light/punctual.h"

namespace sateen::light {

/// Light for lit materials where nobody chose any, in view space, standing with the camera.
struct DefaultLighting {
  std::vector<PunctualLight>
      lamps;  ///< a key from the upper left in front, a rim light from the upper right behind
  Image sky;  ///< soft light from all around, 128 x 64 (light/environment.h)
};

/// The same on every call. Scaled so that a white diffuse surface that faces the viewer sends radiance 1,
/// within a twentieth: a grey card of 0.18 is middle grey at exposure 0. Nothing in it is black: the darkest
/// way a visible surface can face receives a fifth of that, and the brightest twice.
DefaultLighting default_lighting();

}  // namespace sateen::light
