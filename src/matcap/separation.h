// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sateen/core/image.h"
#include "sateen/matcap/sphere_disc.h"

namespace sateen::matcap {

/// The values in which low and high add up to the MatCap.
enum class AddUpSpace {
  display,  ///< sRGB-encoded values, as in the authors' published data: what painters see and blend
  linear,   ///< linear light
};

/// Low- and high-frequency parts of a MatCap (Zubiaga et al. 2015, section 4.1), akin to its diffuse and
/// specular light.
struct Separation {
  Image low;   ///< 3 channels, in the space they add up in; never above the input
  Image high;  ///< input - low, so that low + high is the input; negative only where the input is
};

/// Pixels that must not pull the erosion down: those of the outermost ring, which mix with the background,
/// and isolated black ones (value <= 0 in a channel with at least seven of the eight neighbours on the sphere
/// above 0 there). Because erosion divides by a cosine, a single 0 would otherwise set a whole hemisphere to
/// 0.
enum class Outliers {
  ignore,  ///< left out of the erosion; low is still kept below the input there
  keep,    ///< every pixel counts: the opening to the letter
};

/// Morphological opening with cosine weights of one channel (section 4.1, after Sternberg 1986):
///   erode(p)  = min over q of v_q / (n_p . n_q),   1 / erode(p) = max over q of n_p . (n_q / v_q)
///   dilate(p) = max over q of v_q (n_p . n_q)
/// `values` is row-major over the picture; pixels off the disc are ignored and come back as 0; pixels with
/// `ignored` set (empty: none) do not enter the erosion. Negative values count as 0. Exact: bit for bit what
/// comparing all pairs of pixels in single precision gives, see support_function.h. The result is never above
/// max(value, 0).
std::vector<float> cosine_opening(const std::vector<float>& values, const std::vector<char>& ignored,
                                  int width, int height, const Disc& disc);

/// The pixels of one channel that Outliers::ignore leaves out, 1 for each such pixel.
std::vector<char> find_outliers(const std::vector<float>& values, int width, int height, const Disc& disc);

/// Opens every colour channel of `picture`, which holds values in the space they shall add up in (see
/// to_add_up_space). Off the disc both parts are 0. Throws Error naming `name` when a value is not finite.
Separation separate(const Image& picture, const Disc& disc, Outliers outliers, const std::string& name);

/// A linear picture's three colour channels in the space low and high add up in; and back.
Image to_add_up_space(const Image& linear, AddUpSpace space);
Image from_add_up_space(const Image& values, AddUpSpace space);

}  // namespace sateen::matcap
