// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/ggx.h"
#include "sateen/brdf/json_reader.h"

// Parameters of the models from JSON, one spelling for `brdf eval` and for material files. Angles are degrees
// there and radians inside. Include in .cpp files only.

namespace sateen {

/// Keys alpha_t, alpha_b, azimuth; in their place matrix ([Sxx, Sxy, Syy]), or convention (gltf, materialx,
/// blender, filament; conventions.h) with roughness, anisotropy, rotation; f0; energy_compensation.
GgxParameters read_ggx(JsonObject& json);

/// Keys density, alpha or k, phase, tilt, azimuth, color; in their place convention (gltf:
/// KHR_materials_sheen) with sheen_color and sheen_roughness.
FuzzParameters read_fuzz(JsonObject& json);

}  // namespace sateen
