// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/vector.h"

namespace sateen::brdf {

// The slides' simplified fuzz for deferred shading (Patry, "Samurai Shading"): fixed parameters, a multiple
// of the Lambert colour, wrapped lighting in place of u.n. Directions in the shading frame.

/// Radiance per irradiance on a surface facing the light.
Vec3 simple_fuzz_lit(const Vec3& color, const Vec3& light, const Vec3& view);
/// Under surroundings of a mean radiance over the hemisphere.
Vec3 simple_fuzz_surroundings(const Vec3& color, const Vec3& mean, const Vec3& view);

}  // namespace sateen::brdf
