// SPDX-License-Identifier: MIT
#include "sateen/matcap/decomposition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sateen/core/parallel.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/rim.h"
#include "sateen/matcap/sphere_blur.h"
#include "sateen/matcap/unwarp.h"
#include "sateen/matcap/warp.h"

namespace sateen::matcap {
namespace {

Image divided_by(Image image, const Vec3& color) {
  const Vec3f factor = color.cwiseInverse().cast<float>();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, image.rgb(x, y).cwiseProduct(factor));
  }
  return image;
}

Image sum_of(const Separation& components) {
  Image sum = components.low;
  for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += components.high.data[i];
  return sum;
}

MatcapPart part_of(const Image& component, const Disc& disc, const std::vector<Region>& regions,
                   double fallback, int map_size, double rim, const std::string& name) {
  MatcapPart part;
  part.base_color = base_color_of(component, disc);
  const FilterEstimate estimate = regions.empty() ? estimate_filter(component, disc, fallback)
                                                  : estimate_filter(component, disc, regions, fallback, name);
  part.variance = estimate.variance;
  part.measured = estimate.measured;
  part.feature = estimate.feature;
  part.regions = estimate.regions;
  part.map =
      prefilter(unwarp_to_sphere(divided_by(component, part.base_color), disc, part.slope(), map_size, rim));
  return part;
}

/// A sphere larger than options.largest_radius, decomposed at that size. Regions stay in the pixels of the
/// picture given.
MatcapDecomposition decompose_smaller(const Image& picture, const Disc& disc, const DecomposeOptions& options,
                                      const std::string& name, double shrink) {
  const auto scaled = [&](int length) { return std::max(1, static_cast<int>(std::lround(length * shrink))); };
  const Image smaller = resized(picture, scaled(picture.width), scaled(picture.height));
  const double across = static_cast<double>(smaller.width) / picture.width;
  const double down = static_cast<double>(smaller.height) / picture.height;
  DecomposeOptions smaller_options = options;
  for (auto& regions : smaller_options.regions) {
    for (Region& r : regions) {
      r = overlap(r, picture.width, picture.height);
      r = {static_cast<int>(r.x * across), static_cast<int>(r.y * down), scaled(r.width), scaled(r.height)};
    }
  }
  const Disc place{disc.x * across, disc.y * down,
                   std::min(options.largest_radius, disc.radius * std::min(across, down))};
  MatcapDecomposition result = decompose(smaller, place, smaller_options, name);
  for (MatcapPart& part : result.parts) {
    for (Region& r : part.regions) {
      r = {static_cast<int>(r.x / across), static_cast<int>(r.y / down),
           static_cast<int>(std::ceil(r.width / across)), static_cast<int>(std::ceil(r.height / down))};
    }
  }
  return result;
}

}  // namespace

double MatcapPart::slope() const {
  return slope_of_variance(variance);
}

int default_map_size(const Disc& disc) {
  const int diameter = static_cast<int>(std::lround(2 * disc.radius));
  return std::clamp((diameter + 7) / 8 * 8, kSmallestMap, kLargestMap);
}

MatcapDecomposition decompose(const Separation& components, const Disc& disc, const DecomposeOptions& options,
                              const std::string& name) {
  check_disc(disc, components.low.width, components.low.height, name);
  const int map_size = options.map_size > 0 ? options.map_size : default_map_size(disc);
  MatcapDecomposition result;
  result.space = options.space;
  result.width = components.low.width;
  result.height = components.low.height;
  result.disc = disc;
  const Image picture = sum_of(components);
  const double rim = rim_width(picture, disc);
  parallel_for(2, [&](int i) {
    result.parts[static_cast<std::size_t>(i)] =
        part_of(i == 0 ? components.low : components.high, disc, options.regions[static_cast<std::size_t>(i)],
                i == 0 ? kLambertian : kSatin, map_size, rim, name);
  });
  EditedMatcap shown = unedited(std::move(result));
  shown.matcap.kept = pixels_to_keep(from_add_up_space(picture, options.space), bake(shown), disc);
  return std::move(shown.matcap);
}

MatcapDecomposition decompose(const Image& picture, const Disc& disc, const DecomposeOptions& options,
                              const std::string& name) {
  check_disc(disc, picture.width, picture.height, name);
  if (disc.radius > options.largest_radius) {
    const double shrink = options.largest_radius / disc.radius;
    MatcapDecomposition result = decompose_smaller(picture, disc, options, name, shrink);
    result.width = picture.width;
    result.height = picture.height;
    result.disc = disc;
    // Of all that shrinking loses only the edge, which would show where the sphere was cut out, comes back.
    const double rim = rim_width(to_add_up_space(picture, options.space), disc) / shrink;
    result.kept = pixels_of_rim(with_channels(picture, 3), disc, rim);
    return result;
  }
  return decompose(separate(to_add_up_space(picture, options.space), disc, options.outliers, name), disc,
                   options, name);
}

}  // namespace sateen::matcap
