// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "sateen/core/image.h"

namespace sateen::light {

// Environment maps are latitude-longitude pictures of radiance, linear, row 0 at the zenith (+y). The middle
// column is what a viewer looking along -z sees, and u grows to the right, towards +x: direction (sin a cos
// e, sin e, -cos a cos e) with azimuth a = 2 pi (u - 1/2) and elevation e = pi (1/2 - v), v growing
// downwards.

/// Unit direction from the surface towards texture point (u, v), both in [0, 1].
Vec3 environment_direction(const Vec2& uv);
Vec2 environment_uv(const Vec3& direction);

/// Radiance from a unit direction: bilinear, u cyclic, v clamped.
Vec3 environment_radiance(const Image& environment, const Vec3& direction);

/// Reads a latitude-longitude picture of light. Negative values, which some files hold by accident, become 0;
/// a picture that is not twice as wide as high (within a pixel) is an Error, as is everything read_image
/// refuses.
Image read_environment(const std::filesystem::path& path);

}  // namespace sateen::light
