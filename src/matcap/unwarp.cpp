// SPDX-License-Identifier: MIT
#include "sateen/matcap/unwarp.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"
#include "sateen/matcap/blind_spot.h"
#include "sateen/matcap/warp.h"

namespace sateen {
namespace {

constexpr int kCorrections = 12;

/// The picture with the sphere's rim continued outwards, so that lookups near the rim never see what is
/// behind it.
Image continued_past_rim(const Image& component, const Disc& disc) {
  Image image = component;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (on_disc(disc, x, y)) continue;
      const Vec2 outside = disc_point(disc, x + 0.5, y + 0.5);
      const double distance = outside.norm() * disc.radius;
      image.set_rgb(x, y, Vec3f::Zero());
      if (distance > disc.radius + 4) continue;
      for (double r = disc.radius; r > 0; r -= 0.25) {
        const Vec2 p = disc_pixel(disc, outside * (r / distance));
        const int px = static_cast<int>(std::floor(p.x()));
        const int py = static_cast<int>(std::floor(p.y()));
        if (px < 0 || py < 0 || px >= image.width || py >= image.height || !on_disc(disc, px, py)) continue;
        image.set_rgb(x, y, component.rgb(px, py));
        break;
      }
    }
  }
  return image;
}

/// Catmull-Rom interpolation, kept within the four pixels around the point: sharp, and free of overshoot.
Vec3 sample_sharp(const Image& image, double x, double y) {
  const double fx = x - 0.5;
  const double fy = y - 0.5;
  const int x0 = static_cast<int>(std::floor(fx));
  const int y0 = static_cast<int>(std::floor(fy));
  const auto weights = [](double t) {
    return std::array<double, 4>{((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2,
                                 ((4 - 3 * t) * t + 1) * t / 2, (t - 1) * t * t / 2};
  };
  const auto wx = weights(fx - x0);
  const auto wy = weights(fy - y0);
  Vec3 sum = Vec3::Zero();
  Vec3 low = Vec3::Constant(1e30);
  Vec3 high = -low;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int px = std::clamp(x0 - 1 + i, 0, image.width - 1);
      const int py = std::clamp(y0 - 1 + j, 0, image.height - 1);
      const float* p = image.data.data() + image.index(px, py);
      const Vec3 value(p[0], p[1], p[2]);
      sum += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] * value;
      if (i == 1 || i == 2) {
        if (j == 1 || j == 2) {
          low = low.cwiseMin(value);
          high = high.cwiseMax(value);
        }
      }
    }
  }
  return sum.cwiseMax(low).cwiseMin(high);
}

/// Where one pixel reads: four texels of one hemisphere, as indices of their first channel.
struct Lookup {
  std::array<std::uint32_t, 4> texel;
  std::array<float, 4> weight;
  std::uint32_t pixel;
  bool back;
};

std::vector<Lookup> lookups(const Image& component, const Disc& disc, double slope, int size) {
  std::vector<std::vector<Lookup>> rows(static_cast<std::size_t>(component.height));
  parallel_for(component.height, [&](int y) {
    auto& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < component.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      const Vec3 w = warp(normal_on_disc(disc_point(disc, x + 0.5, y + 0.5)), slope);
      const Vec2 t = map_of_direction(w);
      const double cx = std::clamp((t.x() + 1) / 2 * size - 0.5, 0.0, size - 1.0);
      const double cy = std::clamp((1 - t.y()) / 2 * size - 0.5, 0.0, size - 1.0);
      const int x0 = std::min(static_cast<int>(cx), size - 2);
      const int y0 = std::min(static_cast<int>(cy), size - 2);
      const auto fx = static_cast<float>(cx - x0);
      const auto fy = static_cast<float>(cy - y0);
      const auto index = [&](int tx, int ty) { return static_cast<std::uint32_t>((ty * size + tx) * 3); };
      row.push_back({{index(x0, y0), index(x0 + 1, y0), index(x0, y0 + 1), index(x0 + 1, y0 + 1)},
                     {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy},
                     static_cast<std::uint32_t>(component.index(x, y)),
                     w.z() < 0});
    }
  });
  std::vector<Lookup> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Landweber iterations (simultaneous iterative reconstruction): each texel moves by the weighted mean of the
/// errors of the pixels that read it. Where texels are denser than pixels the errors vanish; elsewhere it is
/// the least squares.
void correct(SphereMap& map, const Image& component, const std::vector<Lookup>& all) {
  std::array<std::vector<float>, 2> received{std::vector<float>(map.front.data.size() / 3),
                                             std::vector<float>(map.front.data.size() / 3)};
  for (const Lookup& l : all) {
    for (std::size_t i = 0; i < 4; ++i) received[l.back ? 1 : 0][l.texel[i] / 3] += l.weight[i];
  }
  std::array<std::vector<float>, 2> change;
  for (int round = 0; round < kCorrections; ++round) {
    for (auto& c : change) c.assign(map.front.data.size(), 0);
    for (const Lookup& l : all) {
      const float* texels = (l.back ? map.back : map.front).data.data();
      float* changes = change[l.back ? 1 : 0].data();
      for (std::uint32_t c = 0; c < 3; ++c) {
        float error = component.data[l.pixel + c];
        for (std::size_t i = 0; i < 4; ++i) error -= l.weight[i] * texels[l.texel[i] + c];
        for (std::size_t i = 0; i < 4; ++i) changes[l.texel[i] + c] += l.weight[i] * error;
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<float>& texels = (side == 0 ? map.front : map.back).data;
      for (std::size_t i = 0; i < texels.size(); ++i) {
        const float weight = received[side][i / 3];
        if (weight > 1e-4F) texels[i] += change[side][i] / std::max(weight, 0.25F);
      }
    }
  }
}

}  // namespace

SphereMap unwarp_to_sphere(const Image& component, const Disc& disc, double slope, int size) {
  const Image picture = continued_past_rim(component, disc);
  const auto colour_at = [&](double theta, double azimuth) -> Vec3 {
    const Vec2 p = disc_pixel(disc, std::sin(theta) * Vec2(std::cos(azimuth), std::sin(azimuth)));
    return sample_sharp(picture, p.x(), p.y());
  };
  const BlindSpot blind_spot(blind_spot_angle(slope), [&](double beyond, double azimuth) {
    return colour_at(std::max(0.0, kPi / 2 - beyond / (1 + slope)), azimuth);
  });
  SphereMap map = make_sphere_map(size, [&](const Vec3& w) -> Vec3 {
    const double across = std::hypot(w.x(), w.y());
    const double theta = std::atan2(across, w.z()) / (1 + slope);
    if (theta > kPi / 2) return blind_spot(w);
    if (across == 0) return colour_at(0, 0);
    const Vec2 p = disc_pixel(disc, w.head<2>() * (std::sin(theta) / across));
    return sample_sharp(picture, p.x(), p.y());
  });
  correct(map, component, lookups(component, disc, slope, size));
  return map;
}

double unwarp_error(const SphereMap& map, const Image& component, const Disc& disc, double slope) {
  std::vector<double> sums(static_cast<std::size_t>(component.height), 0);
  std::vector<double> counts(sums.size(), 0);
  parallel_for(component.height, [&](int y) {
    for (int x = 0; x < component.width; ++x) {
      if (!on_disc(disc, x, y)) continue;
      const Vec3 w = warp(normal_on_disc(disc_point(disc, x + 0.5, y + 0.5)), slope);
      sums[static_cast<std::size_t>(y)] +=
          (sample(map, w) - component.rgb(x, y).cast<double>()).squaredNorm();
      counts[static_cast<std::size_t>(y)] += 3;
    }
  });
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sum += sums[i];
    count += counts[i];
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace sateen
