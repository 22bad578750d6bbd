// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"
#include "sateen/core/vector.h"

namespace sateen {

/// sRGB transfer functions (IEC 61966-2-1), extended oddly to negative values and without clamping above 1.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// The same for every colour channel of a picture; a fourth channel (alpha) is left alone.
Image srgb_encoded(Image linear);
Image srgb_decoded(Image encoded);

/// Relative luminance of linear Rec. 709 light.
double luminance(const Vec3& rgb);

/// Hue in turns [0, 1), saturation [0, 1], value; the usual hexcone. Grey has hue 0.
Vec3 rgb_to_hsv(const Vec3& rgb);
Vec3 hsv_to_rgb(const Vec3& hsv);

}  // namespace sateen
