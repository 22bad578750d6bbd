// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sateen/appearance/json_reader.h"
#include "sateen/brdf/fuzz.h"
#include "sateen/brdf/ggx.h"

// Parameters of the models from JSON, one spelling for `brdf eval` and for material files. Angles are degrees
// there and radians inside. Include in .cpp files only.

namespace sateen::brdf {

/// Keys alpha_t, alpha_b, azimuth; in their place matrix ([Sxx, Sxy, Syy]), or convention (gltf, materialx,
/// blender, filament; conventions.h) with roughness, anisotropy, rotation; f0; energy_compensation.
GgxParameters read_ggx(appearance::JsonObject& json);
/// alpha_t, alpha_b, azimuth, f0, energy_compensation.
std::span<const appearance::ParameterField<GgxParameters>> ggx_parameters();

/// Keys density, alpha or k, phase, tilt, azimuth, color; in their place convention (gltf:
/// KHR_materials_sheen) with sheen_color and sheen_roughness.
FuzzParameters read_fuzz(appearance::JsonObject& json);
/// density, alpha (which sets k too), phase, tilt, azimuth, color.
std::span<const appearance::ParameterField<FuzzParameters>> fuzz_parameters();

}  // namespace sateen::brdf
