// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_map.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen::matcap {

Vec3 direction_of_map(const Vec2& t, bool back) {
  const double r2 = t.squaredNorm();
  const double z = (1 - r2) / (1 + r2);
  return {2 * t.x() / (1 + r2), 2 * t.y() / (1 + r2), back ? -z : z};
}

Vec2 map_of_direction(const Vec3& w) {
  return w.head<2>() / (1 + std::abs(w.z()));
}

Vec3 direction_of_texel(int x, int y, int size, bool back) {
  return direction_of_map({2 * (x + 0.5) / size - 1, 1 - 2 * (y + 0.5) / size}, back);
}

SphereMap make_sphere_map(int size, const std::function<Vec3(const Vec3&)>& colour) {
  SphereMap map{Image(size, size, 3), Image(size, size, 3)};
  parallel_for(2 * size, [&](int row) {
    const bool back = row >= size;
    const int y = back ? row - size : row;
    Image& image = back ? map.back : map.front;
    for (int x = 0; x < size; ++x) {
      image.set_rgb(x, y, colour(direction_of_texel(x, y, size, back)).cast<float>());
    }
  });
  return map;
}

Vec3 sample(const SphereMap& map, const Vec3& direction) {
  const Vec2 t = map_of_direction(direction);
  const int size = map.size();
  Vec3 result;
  sample_bilinear(direction.z() < 0 ? map.back : map.front, (t.x() + 1) / 2 * size, (1 - t.y()) / 2 * size,
                  {result.data(), 3});
  return result;
}

double level_of_variance(const std::vector<double>& variances, double variance) {
  if (!(variance > 0)) return 0;
  const auto above = std::ranges::upper_bound(variances, variance);
  if (above == variances.end()) return static_cast<double>(variances.size() - 1);
  const double high = *above;
  const double low = *(above - 1);
  return static_cast<double>(above - variances.begin() - 1) + (variance - low) / (high - low);
}

Vec3 sample(const PrefilteredMap& map, const Vec3& direction, double variance) {
  const double level = level_of_variance(map.variances, variance);
  const auto fine = static_cast<std::size_t>(level);
  const double fraction = level - static_cast<double>(fine);
  const Vec3 a = sample(map.levels[fine], direction);
  return fraction > 0 ? Vec3(a + fraction * (sample(map.levels[fine + 1], direction) - a)) : a;
}

}  // namespace sateen::matcap
