// SPDX-License-Identifier: MIT
#include "sateen/matcap/decomposition.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"
#include "sateen/matcap/sphere_blur.h"
#include "sateen/matcap/unwarp.h"
#include "sateen/matcap/warp.h"

namespace sateen {
namespace {

Image divided_by(Image image, const Vec3& color) {
  const Vec3f factor = color.cwiseInverse().cast<float>();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, image.rgb(x, y).cwiseProduct(factor));
  }
  return image;
}

MatcapPart part_of(const Image& component, const Disc& disc, const std::vector<Region>& regions, double fallback,
                   int map_size, const std::string& name) {
  MatcapPart part;
  part.base_color = base_color_of(component, disc);
  const FilterEstimate estimate = regions.empty() ? estimate_filter(component, disc, fallback)
                                                  : estimate_filter(component, disc, regions, fallback, name);
  part.variance = estimate.variance;
  part.measured = estimate.measured;
  part.feature = estimate.feature;
  part.regions = estimate.regions;
  part.map = prefilter(unwarp_to_sphere(divided_by(component, part.base_color), disc, part.slope(), map_size));
  return part;
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
  parallel_for(2, [&](int i) {
    result.parts[static_cast<std::size_t>(i)] =
        part_of(i == 0 ? components.low : components.high, disc, options.regions[static_cast<std::size_t>(i)],
                i == 0 ? kLambertian : kSatin, map_size, name);
  });
  return result;
}

MatcapDecomposition decompose(const Image& picture, const Disc& disc, const DecomposeOptions& options,
                              const std::string& name) {
  check_disc(disc, picture.width, picture.height, name);
  return decompose(separate(to_add_up_space(picture, options.space), disc, options.outliers, name), disc, options, name);
}

}  // namespace sateen
