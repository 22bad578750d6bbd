// SPDX-License-Identifier: MIT
#include "sateen/core/disc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/core/parallel.h"

namespace sateen {
namespace {

/// Bilinear sample at continuous pixel coordinates, from those of the four pixels that are trusted.
void sample_trusted(const Image& image, double x, double y, double inset, std::vector<double>& colour) {
  const int x0 = static_cast<int>(x - 0.5);
  const int y0 = static_cast<int>(y - 0.5);
  const double fx = x - 0.5 - x0;
  const double fy = y - 0.5 - y0;
  double sum = 0;
  std::ranges::fill(colour, 0);
  for (int i = 0; i < 4; ++i) {
    const int px = x0 + i % 2;
    const int py = y0 + i / 2;
    if (!inside_disc(px, py, image.width, inset)) continue;
    const double weight = (i % 2 == 1 ? fx : 1 - fx) * (i / 2 == 1 ? fy : 1 - fy);
    const auto pixel = image.pixel(px, py);
    for (std::size_t c = 0; c < colour.size(); ++c) colour[c] += weight * pixel[c];
    sum += weight;
  }
  for (double& v : colour) v /= sum;
}

/// fill_from_rim for the pixels whose centres lie within `reach` of the picture's.
void fill_ring(Image& image, double inset, double reach) {
  const int size = image.width;
  const double half = size / 2.0;
  // One pixel inside the trusted rim: of the four pixels a sample there blends, the inner one is always
  // trusted.
  const double source_radius = half - inset - 1;
  if (source_radius < 0.5) return;
  // Pixels with centres this near are trusted whatever their corners do.
  const double trusted = std::max(0.0, half - inset - 0.75);
  parallel_for(size, [&](int y) {
    std::vector<double> colour(static_cast<std::size_t>(image.channels));
    const double dy = y + 0.5 - half;
    const auto fill = [&](int x) {
      const double dx = x + 0.5 - half;
      const double squared = dx * dx + dy * dy;
      if (squared > reach * reach || inside_disc(x, y, size, inset)) return;
      const double scale = source_radius / std::sqrt(squared);
      sample_trusted(image, half + dx * scale, half + dy * scale, inset, colour);
      std::ranges::transform(colour, image.pixel(x, y).begin(),
                             [](double v) { return static_cast<float>(v); });
    };
    const double chord = std::sqrt(std::max(0.0, trusted * trusted - dy * dy));
    const int left_end = chord > 0 ? static_cast<int>(std::ceil(half - chord - 0.5)) : size;
    for (int x = 0; x < left_end; ++x) fill(x);
    for (int x = std::max(left_end, static_cast<int>(half + chord - 0.5)); x < size; ++x) fill(x);
  });
}

/// Gives pixels farther than `radius` from the centre the colour a pixel inside it, where all pixels are
/// good.
void fill_beyond(Image& image, double radius) {
  const double half = image.width / 2.0;
  std::vector<double> colour(static_cast<std::size_t>(image.channels));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double dx = x + 0.5 - half;
      const double dy = y + 0.5 - half;
      const double distance = std::hypot(dx, dy);
      if (distance <= radius) continue;
      const double scale = std::max(0.0, radius - 1.5) / distance;
      sample_bilinear(image, half + dx * scale, half + dy * scale, colour);
      std::ranges::transform(colour, image.pixel(x, y).begin(),
                             [](double v) { return static_cast<float>(v); });
    }
  }
}

}  // namespace

bool inside_disc(int x, int y, int size, double inset) {
  const double half = size / 2.0;
  const double corner_x = std::abs(x + 0.5 - half) + 0.5;
  const double corner_y = std::abs(y + 0.5 - half) + 0.5;
  const double radius = half - inset;
  return radius > 0 && corner_x * corner_x + corner_y * corner_y <= radius * radius;
}

void fill_from_rim(Image& image, double inset) {
  fill_ring(image, inset, std::numeric_limits<double>::infinity());
}

Image resized_disc(Image image, int size, double inset) {
  const double scale = static_cast<double>(image.width) / size;
  if (scale < 2) {
    fill_from_rim(image, inset);
    return resized(image, size, size);
  }
  // Only what texels on the rim average is filled in the large picture, the rest in the small one.
  fill_ring(image, inset, image.width / 2.0 + 1.5 * scale + 1);
  Image small = resized(image, size, size);
  fill_beyond(small, size / 2.0 + 0.75);
  return small;
}

}  // namespace sateen
