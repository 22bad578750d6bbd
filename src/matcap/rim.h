// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// How many pixels from the disc's edge inwards mix with what is behind the sphere; 0 if `picture` (3
/// channels) goes on smoothly to its edge. They are no light: unwarped, the steps of a drawn circle become
/// comb-like streaks, up to ten degrees long behind the object, that come into view when the light turns. The
/// sphere maps leave them out.
double rim_width(const Image& picture, const Disc& disc);

/// Whether pixel (x, y) is on the disc and within `width` pixels of its edge.
bool on_rim(const Disc& disc, double width, int x, int y);

}  // namespace sateen::matcap
