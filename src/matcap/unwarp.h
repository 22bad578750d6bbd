// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"
#include "sateen/matcap/sphere_map.h"

namespace sateen::matcap {

/// Turns a component of a MatCap into the sphere map that warp() reads (Zubiaga et al. 2015, section 4.2):
/// each texel takes the colour of the normal that looks in its direction, the blind spot is filled
/// (blind_spot.h). Then the texels are corrected in a few rounds so that bilinear lookups at the pixels'
/// normals give the component back. `component` has 3 channels, off the disc it is not read; `slope` is mu;
/// `size` texels across. Pixels whose centres lie within `rim` pixels of the disc's edge are not read: what
/// they would show belongs to the blind spot then.
SphereMap unwarp_to_sphere(const Image& component, const Disc& disc, double slope, int size, double rim = 0);

/// Root mean square over the sphere's pixels and channels of component - lookup.
double unwarp_error(const SphereMap& map, const Image& component, const Disc& disc, double slope);

}  // namespace sateen::matcap
