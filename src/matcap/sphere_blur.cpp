// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_blur.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sateen/core/parallel.h"

namespace sateen::matcap {
namespace {

constexpr double kSupport = 12;  // d0^2 over the variance of (1 - d^2 / d0^2)^4 in the plane: 2 (4 + 2)
constexpr double kTexelsOfBlur = 0.75;
// Bilinear lookups blur too, by a sixth of a texel's width squared: texels are half as wide at the equator as
// at the centre of a map, which this is the middle of, in squared widths at the centre.
constexpr double kLookupBlur = 0.1;
constexpr int kSmallest = 4;  // texels across the last level

/// So many neighbours in a row are weighed at once.
constexpr std::size_t kAtOnce = 4;
using Lanes = Eigen::Array<float, kAtOnce, 1>;

/// One number for each texel of a map, row by row, and room to read whole lanes from the last.
using Plane = std::vector<float>;

Plane plane_of(int size) {
  return Plane(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) + kAtOnce, 0.0F);
}

std::size_t texel_index(int size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
}

/// Directions and solid angles (0 past the equator) of the front map's texels; the back's have -z.
struct Geometry {
  int size = 0;
  Plane x, y, z, weight;
};

Geometry geometry_of(int size) {
  Geometry g{size, plane_of(size), plane_of(size), plane_of(size), plane_of(size)};
  parallel_for(size, [&](int row) {
    for (int column = 0; column < size; ++column) {
      const std::size_t i = texel_index(size, column, row);
      const Vec2 p(2 * (column + 0.5) / size - 1, 1 - 2 * (row + 0.5) / size);
      const Vec3 w = direction_of_map(p, false);
      g.x[i] = static_cast<float>(w.x());
      g.y[i] = static_cast<float>(w.y());
      g.z[i] = static_cast<float>(w.z());
      // Solid angle per texel area, 4 / (1 + t^2)^2; the equator cuts texels, which fades over one texel's
      // width.
      const double r2 = p.squaredNorm();
      const double inside = std::clamp((1 - std::sqrt(r2)) * size / 2 + 0.5, 0.0, 1.0);
      g.weight[i] = static_cast<float>(inside * 4 / ((1 + r2) * (1 + r2)));
    }
  });
  return g;
}

struct Colours {
  Plane r, g, b;
};

Colours colours_of(const Image& image) {
  const int size = image.width;
  Colours colours{plane_of(size), plane_of(size), plane_of(size)};
  parallel_for(size, [&](int row) {
    for (int column = 0; column < size; ++column) {
      const std::size_t i = texel_index(size, column, row);
      colours.r[i] = image.data[3 * i];
      colours.g[i] = image.data[3 * i + 1];
      colours.b[i] = image.data[3 * i + 2];
    }
  });
  return colours;
}

/// Weighted sums of one filter.
struct Sums {
  Lanes r = Lanes::Zero();
  Lanes g = Lanes::Zero();
  Lanes b = Lanes::Zero();
  Lanes weight = Lanes::Zero();
};

/// Adds the texels from `first` to `end`, and up to three more: the filter leaves out those beyond its reach.
void gather(const Geometry& map, const Colours& colours, std::size_t first, std::size_t end, const Vec3f& w,
            float scale, Sums& sums) {
  const auto lanes = [](const Plane& plane, std::size_t i) {
    return Eigen::Map<const Lanes>(plane.data() + i);
  };
  const Vec3f scaled = scale * w;
  for (std::size_t i = first; i < end; i += kAtOnce) {
    // d^2 = 2 (1 - w . texel), so that 1 - d^2 / d0^2 = 1 - scale + scale (w . texel).
    Lanes q = (1 - scale) + scaled.x() * lanes(map.x, i) + scaled.y() * lanes(map.y, i) +
              scaled.z() * lanes(map.z, i);
    q = q.max(0.0F).square();
    const Lanes weight = q * q * lanes(map.weight, i);
    sums.r += weight * lanes(colours.r, i);
    sums.g += weight * lanes(colours.g, i);
    sums.b += weight * lanes(colours.b, i);
    sums.weight += weight;
  }
}

/// Adds what lies within the cap of angular radius `reach` around `w` on the front; for the back, mirror `w`.
void gather_cap(const Geometry& map, const Colours& colours, const Vec3& w, double reach, float scale,
                Sums& sums) {
  if (w.z() < -std::sin(reach)) return;
  // The projection is stereographic: a circle on the sphere is a circle on the map, unless the cap holds the
  // point opposite, which is at infinity.
  const double below = std::cos(reach) + w.z();
  const bool bounded = below > 1e-3;
  const Vec2 centre = bounded ? Vec2(w.head<2>() / below) : Vec2(0, 0);
  const double radius = bounded ? std::sin(reach) / below : 2;
  const int size = map.size;
  const auto column = [&](double p) { return (p + 1) / 2 * size; };
  const int y0 = static_cast<int>(std::clamp(size - column(centre.y() + radius) - 0.5, 0.0, size - 1.0));
  const int y1 = static_cast<int>(std::clamp(size - column(centre.y() - radius) + 0.5, 0.0, size - 1.0));
  for (int y = y0; y <= y1; ++y) {
    const double dy = 1 - 2 * (y + 0.5) / size - centre.y();
    const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
    const int x0 = static_cast<int>(std::clamp(column(centre.x() - half) - 0.5, 0.0, size - 1.0));
    const int x1 = static_cast<int>(std::clamp(column(centre.x() + half) + 0.5, 0.0, size - 1.0));
    gather(map, colours, texel_index(size, x0, y), texel_index(size, x1, y) + 1, w.cast<float>(), scale,
           sums);
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
  const Geometry geometry = geometry_of(map.size());
  const Colours front = colours_of(map.front);
  const Colours back = colours_of(map.back);
  const double chord2 = std::min(kSupport * variance, 4.0);
  const double reach = 2 * std::asin(std::sqrt(chord2) / 2);
  const auto scale = static_cast<float>(2 / (kSupport * variance));
  return make_sphere_map(size, [&](const Vec3& w) -> Vec3 {
    Sums sums;
    gather_cap(geometry, front, w, reach, scale, sums);
    gather_cap(geometry, back, {w.x(), w.y(), -w.z()}, reach, scale, sums);
    const float total = sums.weight.sum();
    // A filter narrower than a texel can miss all centres: then there is nothing to blur.
    if (!(total > 0)) return sample(map, w);
    return Vec3(sums.r.sum(), sums.g.sum(), sums.b.sum()) / total;
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

}  // namespace sateen::matcap
