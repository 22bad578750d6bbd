// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "sateen/appearance/appearance.h"
#include "sateen/core/image.h"
#include "sateen/core/progress.h"

namespace sateen::scene {

/// Pictures of a surface, all of one size, row 0 on top, by the fields they hold: those with an input name in
/// surface_fields.h. Directions may have any length; a normal, tangent or position of zero is an empty
/// pixel. Without positions the view is +z everywhere; with them the eye is at the origin.
using ShadeInputs = std::map<appearance::SurfaceField, Image>;

/// Shades every pixel with the appearance's C++ evaluator, no rasteriser involved, in parallel. RGBA, linear;
/// empty pixels are 0. Throws Error when normals are missing, sizes differ, a picture has too few channels,
/// or the appearance needs what is not there.
Image shade(const appearance::Appearance& appearance, const ShadeInputs& inputs,
            const light::Lighting& lighting = {}, const Progress& progress = {});

}  // namespace sateen::scene
