// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/separation.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen {

/// The outermost pixels of a MatCap where they mix with what is behind the sphere. They are no light:
/// unwarped, the steps of a drawn circle become comb-like streaks, up to ten degrees long behind the object,
/// that come into view when the light turns. The sphere maps leave them out, and baking puts them back as
/// long as nothing is edited.
struct Rim {
  double width = 0;  ///< pixels whose centres lie this close to the disc's edge; 0: none are left out
  std::vector<Vec3f> colours;  ///< theirs, row by row, linear light

  bool empty() const { return colours.empty(); }
};

/// Whether pixel (x, y) is on the disc and within `width` pixels of its edge.
bool on_rim(const Disc& disc, double width, int x, int y);

/// The rim of `picture` (3 channels, in `space`): nothing if it goes on smoothly from the pixels inside.
Rim rim_of(const Image& picture, const Disc& disc, AddUpSpace space);

/// The rim of this width, `picture` in linear light.
Rim rim_pixels(const Image& picture, const Disc& disc, double width);

/// Puts the rim's pixels back into a picture of the same size, linear light.
void put_back(const Rim& rim, const Disc& disc, Image& picture);

}  // namespace sateen
