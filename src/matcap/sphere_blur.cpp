// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_blur.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen {
namespace {

constexpr double kSupport = 12;  // d0^2 over the variance of (1 - d^2 / d0^2)^4 in the plane: 2 (4 + 2)
constexpr double kTexelsOfBlur = 0.75;
// Bilinear lookups blur too, by a sixth of a texel's width squared: texels are half as wide at the equator as
// at the centre of a map, which this is the middle of, in squared widths at the centre.
constexpr double kLookupBlur = 0.1;
constexpr int kSmallest = 4;  // texels across the last level

/// The texels of both hemispheres in planes, with direction and solid angle (0 past the equator).
struct Texels {
  int size = 0;
  std::vector<float> x, y, z, weight, r, g, b;
};

Texels texels_of(const Image& image, bool back) {
  Texels t;
  t.size = image.width;
  const std::size_t n = static_cast<std::size_t>(t.size) * static_cast<std::size_t>(t.size);
  for (auto* plane : {&t.x, &t.y, &t.z, &t.weight, &t.r, &t.g, &t.b}) plane->resize(n);
  parallel_for(t.size, [&](int row) {
    for (int column = 0; column < t.size; ++column) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(t.size) + static_cast<std::size_t>(column);
      const Vec2 p(2 * (column + 0.5) / t.size - 1, 1 - 2 * (row + 0.5) / t.size);
      const Vec3 w = direction_of_map(p, back);
      t.x[i] = static_cast<float>(w.x());
      t.y[i] = static_cast<float>(w.y());
      t.z[i] = static_cast<float>(w.z());
      // Solid angle per texel area, 4 / (1 + t^2)^2; the equator cuts texels, which fades over one texel's
      // width.
      const double r2 = p.squaredNorm();
      const double inside = std::clamp((1 - std::sqrt(r2)) * t.size / 2 + 0.5, 0.0, 1.0);
      t.weight[i] = static_cast<float>(inside * 4 / ((1 + r2) * (1 + r2)));
      t.r[i] = image.data[3 * i];
      t.g[i] = image.data[3 * i + 1];
      t.b[i] = image.data[3 * i + 2];
    }
  });
  return t;
}

/// Weighted sums of one filter: red, green, blue, weight.
using Sums = std::array<float, 4>;

void gather(const Texels& t, std::size_t first, std::size_t count, const Vec3f& w, float scale, Sums& sums) {
  float r = 0;
  float g = 0;
  float b = 0;
  float total = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    // d^2 = 2 (1 - w . texel), so that 1 - d^2 / d0^2 = 1 - scale + scale (w . texel).
    float q = 1 - scale + scale * (w.x() * t.x[i] + w.y() * t.y[i] + w.z() * t.z[i]);
    q = q > 0 ? q : 0;
    q *= q;
    const float weight = q * q * t.weight[i];
    r += weight * t.r[i];
    g += weight * t.g[i];
    b += weight * t.b[i];
    total += weight;
  }
  sums[0] += r;
  sums[1] += g;
  sums[2] += b;
  sums[3] += total;
}

/// Adds what lies within the cap of angular radius `reach` around `w` on one hemisphere. A circle on the
/// sphere is a circle on the map: that projection is stereographic.
void gather_cap(const Texels& t, bool back, const Vec3& w, double reach, float scale, Sums& sums) {
  const double across = std::hypot(w.x(), w.y());
  const double angle = std::atan2(across, back ? -w.z() : w.z());
  const double near = std::tan((angle - reach) / 2);
  if (near > 1) return;
  const double far = std::tan(std::min((angle + reach) / 2, 0.49 * kPi));
  const Vec2 azimuth = across > 0 ? Vec2(w.x() / across, w.y() / across) : Vec2(1, 0);
  const Vec2 centre = (near + far) / 2 * azimuth;
  const double radius = (far - near) / 2;
  const auto column = [&](double p) { return (p + 1) / 2 * t.size; };
  const int y0 = std::max(0, static_cast<int>(std::floor(t.size - column(centre.y() + radius) - 0.5)));
  const int y1 =
      std::min(t.size - 1, static_cast<int>(std::ceil(t.size - column(centre.y() - radius) - 0.5)));
  for (int y = y0; y <= y1; ++y) {
    const double dy = 1 - 2 * (y + 0.5) / t.size - centre.y();
    const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
    const int x0 = std::max(0, static_cast<int>(std::floor(column(centre.x() - half) - 0.5)));
    const int x1 = std::min(t.size - 1, static_cast<int>(std::ceil(column(centre.x() + half) - 0.5)));
    if (x1 < x0) continue;
    gather(t, static_cast<std::size_t>(y) * static_cast<std::size_t>(t.size) + static_cast<std::size_t>(x0),
           static_cast<std::size_t>(x1 - x0 + 1), w.cast<float>(), scale, sums);
  }
}

double texel_width(int size) {
  return 4.0 / size;  // radians at the centre of a map
}

/// The variance bilinear lookups in a map of `size` texels add.
double lookup_variance(int size) {
  return kLookupBlur * texel_width(size) * texel_width(size);
}

/// The blur that is in the texels of a level, without what lookups add.
double stored_variance(const PrefilteredMap& map, std::size_t level) {
  return level == 0 ? 0 : map.variances[level] - lookup_variance(map.levels[level].size());
}

}  // namespace

SphereMap blurred(const SphereMap& map, double variance, int size) {
  if (variance <= 0) {
    if (size == map.size()) return map;
    return make_sphere_map(size, [&](const Vec3& w) { return sample(map, w); });
  }
  const Texels front = texels_of(map.front, false);
  const Texels back = texels_of(map.back, true);
  const double chord2 = std::min(kSupport * variance, 4.0);
  const double reach = 2 * std::asin(std::sqrt(chord2) / 2);
  const auto scale = static_cast<float>(2 / (kSupport * variance));
  return make_sphere_map(size, [&](const Vec3& w) -> Vec3 {
    Sums sums{};
    gather_cap(front, false, w, reach, scale, sums);
    gather_cap(back, true, w, reach, scale, sums);
    // A filter narrower than a texel can miss all centres: then there is nothing to blur.
    if (!(sums[3] > 0)) return sample(map, w);
    return Vec3(sums[0], sums[1], sums[2]) / sums[3];
  });
}

PrefilteredMap prefilter(SphereMap map) {
  PrefilteredMap result;
  const int size = map.size();
  result.levels.push_back(std::move(map));
  result.variances.push_back(0);
  for (int level = 1; size >> level >= kSmallest; ++level) {
    const int smaller = size >> level;
    const double width = texel_width(smaller);
    const double variance = kTexelsOfBlur * kTexelsOfBlur * width * width;
    const double stored = stored_variance(result, result.levels.size() - 1);
    result.levels.push_back(
        blurred(result.levels.back(), variance - lookup_variance(smaller) - stored, smaller));
    result.variances.push_back(variance);
  }
  return result;
}

SphereMap blurred(const PrefilteredMap& map, double variance) {
  if (!(variance > 0)) return map.levels.front();
  // The filter should be wider than the texels it gathers from and those it is sampled at.
  std::size_t level = 0;
  while (level + 1 < map.levels.size() && map.variances[level + 1] < 0.5 * variance) ++level;
  const int size = map.levels[level].size();
  const double looked_up = level == 0 ? 0 : lookup_variance(size);
  const SphereMap coarse =
      blurred(map.levels[level], variance - stored_variance(map, level) - looked_up, size);
  return blurred(coarse, 0, map.levels.front().size());
}

}  // namespace sateen
