// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/signature.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// A rectangle of pixels around a sharp feature of a MatCap.
using Region = PixelRect;

/// What a signature is taken of (section 3.3): the component R where a light is a point or a line across
/// theta, its derivative dR/dtheta where a light is an edge.
enum class Feature { line, edge };

/// The variance nu of a component's material filter and where it came from.
struct FilterEstimate {
  double variance = 0;     ///< radians^2, within [one pixel^2, kFlattest]
  bool measured = false;   ///< false: no feature was sharp enough, `variance` is the component's fallback
  bool automatic = false;  ///< the regions were found, not given
  std::vector<Region> regions;
  Feature feature = Feature::line;
  double theta = 0;     ///< of the deciding pixel, radians from the view axis
  double azimuth = 0;   ///< radians from x to y
  Signature signature;  ///< of the deciding pixel
};

/// The variance at which slope_of_variance reaches 0: broader filters all look along the normal.
inline constexpr double kFlattest = 0.8277;

/// What a low part is taken to have in which nothing is sharp. Separation leaves an envelope of cosine lobes,
/// in which nothing is sharper than Lambertian shading, and the signature of a cosine lobe settles above
/// 0.7. Here the slope is 0, as section 3.1 has it for diffuse light: such shading turns as far as its light
/// does. (The lobe's variance as a whole, pi^2/4 - 2 = 0.467, would give a slope of 0.62 and turn it by 62
/// %.)
inline constexpr double kLambertian = kFlattest;

/// The least variance over the pixels of the regions, each with the signature of R and, where the profile is
/// an edge between two plateaus, of dR/dtheta. A careful user draws regions around the sharpest features.
/// `component` has 3 channels; `fallback` is the variance when no signature is valid.
/// Throws Error naming `name` when a region has no pixel on the sphere.
FilterEstimate estimate_filter(const Image& component, const Disc& disc, const std::vector<Region>& regions,
                               double fallback, const std::string& name);

/// The same with a region found: along meridians all over the sphere, ridges and edges that stand out by at
/// least a fifth of the brightest value give candidates. The sharpest one that the meridians 2 and 4 pixels
/// beside it confirm is taken, so that grain and compression noise, sharp but alone, are not; the pixels
/// around it are the region.
FilterEstimate estimate_filter(const Image& component, const Disc& disc, double fallback);

/// The colour at the brightest point (section 3.2), by luminance; channels are kept above a thousandth of the
/// largest, so that dividing by it is safe. White for a black component.
Vec3 base_color_of(const Image& component, const Disc& disc);

}  // namespace sateen::matcap
