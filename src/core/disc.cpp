// SPDX-License-Identifier: MIT
#include "sateen/core/disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen {
namespace {

/// Texel (x, y) relative to the disc's centre, in units of half a texel: whole numbers, so that "inside" is
/// exact.
bool is_inside(int x, int y, int size) {
  const long dx = 2L * x + 1 - size;
  const long dy = 2L * y + 1 - size;
  return dx * dx + dy * dy <= static_cast<long>(size) * size;
}

}  // namespace

void fill_from_rim(Image& picture) {
  const int size = picture.width;
  const double radius = size / 2.0;
  // A texel diagonal inside the rim, at least one of the four texels around a point is inside the disc.
  const double reach = std::max(0.0, radius - std::sqrt(0.5));
  const Image original = picture;
  parallel_for(picture.height, [&](int y) {
    for (int x = 0; x < size; ++x) {
      if (is_inside(x, y, size)) continue;
      const double dx = x + 0.5 - radius;
      const double dy = y + 0.5 - radius;
      const double scale = reach / std::hypot(dx, dy);
      const double px = radius + dx * scale - 0.5;
      const double py = radius + dy * scale - 0.5;
      const int x0 = static_cast<int>(std::floor(px));
      const int y0 = static_cast<int>(std::floor(py));
      double total = 0;
      std::array<double, 4> sum{};
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          const int sx = x0 + i;
          const int sy = y0 + j;
          if (sx < 0 || sy < 0 || sx >= size || sy >= size || !is_inside(sx, sy, size)) continue;
          const double weight = (1 - std::abs(px - sx)) * (1 - std::abs(py - sy));
          total += weight;
          const auto texel = original.pixel(sx, sy);
          for (std::size_t c = 0; c < texel.size() && c < sum.size(); ++c) sum[c] += weight * texel[c];
        }
      }
      if (total <= 0) continue;
      const auto out = picture.pixel(x, y);
      for (std::size_t c = 0; c < out.size() && c < sum.size(); ++c)
        out[c] = static_cast<float>(sum[c] / total);
    }
  });
}

}  // namespace sateen
