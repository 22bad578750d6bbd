// SPDX-License-Identifier: MIT
#include "sateen/core/disc.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen {

bool inside_disc(int x, int y, int size, double inset) {
  const double half = size / 2.0;
  const double outer_corner = std::hypot(std::abs(x + 0.5 - half) + 0.5, std::abs(y + 0.5 - half) + 0.5);
  return outer_corner <= half - inset;
}

void fill_from_rim(Image& image, double inset) {
  const int size = image.width;
  if (size < 4) return;
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  // Colours of trusted pixels with a last channel of 1, all others 0: sampling and dividing ignores the background.
  Image trusted(size, size, image.channels + 1);
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      if (!inside_disc(x, y, size, inset)) continue;
      const auto out = trusted.pixel(x, y);
      std::ranges::copy(image.pixel(x, y), out.begin());
      out[channels] = 1;
    }
  });
  const double half = size / 2.0;
  // One pixel inside the trusted rim: of the four pixels a sample there blends, the inner one is always trusted.
  const double source_radius = half - inset - 1;
  parallel_for(size, [&](int y) {
    std::vector<double> sample(channels + 1);
    for (int x = 0; x < size; ++x) {
      if (trusted.pixel(x, y)[channels] > 0) continue;
      const double dx = x + 0.5 - half;
      const double dy = y + 0.5 - half;
      const double scale = source_radius / std::hypot(dx, dy);
      sample_bilinear(trusted, half + dx * scale, half + dy * scale, sample);
      const auto out = image.pixel(x, y);
      for (std::size_t c = 0; c < channels; ++c) out[c] = static_cast<float>(sample[c] / sample[channels]);
    }
  });
}

Image resized_disc(Image image, int size, double inset) {
  fill_from_rim(image, inset);
  return resized(image, size, size);
}

}  // namespace sateen
