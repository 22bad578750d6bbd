// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"

namespace sateen {

// A square picture of a sphere that touches its four sides: the inscribed disc shows the sphere, the corners
// do not.

/// How far inside the outline, in pixels of the picture, a pixel's outer edge must lie for the pixel to be
/// trusted: a camera's or renderer's pixel filter spreads the background a little across the outline.
inline constexpr double kRimInset = 0.5;

/// True if pixel (x, y) of a size x size picture lies wholly inside the disc, `inset` pixels away from its
/// outline.
bool inside_disc(int x, int y, int size, double inset = kRimInset);

/// Replaces every pixel that is not inside_disc by the trusted colour towards the centre, so that filtering
/// never sees background. Pictures must be square; one too small to hold a trusted pixel stays as it is.
void fill_from_rim(Image& image, double inset = kRimInset);

/// The picture filled from the rim, then area-filtered to size x size.
Image resized_disc(Image image, int size, double inset = kRimInset);

}  // namespace sateen
