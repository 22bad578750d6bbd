// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/ggx.h"
#include "sateen/light/lighting.h"

namespace sateen::brdf {

/// The mean radiance of surroundings over a GGX lobe, to be scaled by the lobe's reflectance in uniform light
/// (GgxAlbedo). Karis' split sum (2013) stretched: `lookups` reads along the long axis of the lobe, each
/// blurred as the narrow one is, about the dominant direction of Lagarde and de Rousiers ("Moving Frostbite
/// to PBR", 2014), which leans from the mirror direction towards the normal. 0 where nothing is reflected
/// from above the horizon.
///
/// The lobe's axis is the first column of `frame` (tangent, bitangent, normal in the map's space): alpha_t >=
/// alpha_b, and the azimuth is taken as 0; `view` lies in that frame, above the horizon.
/// shaders/appearance/ggx_surroundings.glsl does the same.
Vec3 ggx_surroundings(const light::Surroundings& surroundings, const AnisotropicRoughness& lobe,
                      const Mat3& frame, const Vec3& view, int lookups);

}  // namespace sateen::brdf
