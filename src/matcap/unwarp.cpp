// SPDX-License-Identifier: MIT
#include "sateen/matcap/unwarp.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"
#include "sateen/matcap/blind_spot.h"
#include "sateen/matcap/warp.h"

namespace sateen::matcap {
namespace {

constexpr int kCorrections = 12;           // at most
constexpr float kSmallError = 0.1F / 255;  // of the base colour: once no texel moves further, corrections end

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

/// Where one pixel reads: a square of four texels of one hemisphere.
struct Lookup {
  std::uint32_t texel;  ///< index of the left upper one; those of the back follow the front's
  std::uint32_t pixel;  ///< index of the pixel's first channel
  float right, down;    ///< weights of the right and of the lower texels

  /// Weights of left upper, right upper, left lower and right lower.
  std::array<float, 4> weights() const {
    return {(1 - right) * (1 - down), right * (1 - down), (1 - right) * down, right * down};
  }
};

std::vector<Lookup> lookups(const Image& component, const Disc& disc, const Disc& read, double slope,
                            int size) {
  std::vector<std::size_t> first(static_cast<std::size_t>(component.height) + 1, 0);
  for (int y = 0; y < component.height; ++y) {
    std::size_t count = 0;
    for (int x = 0; x < component.width; ++x) count += on_disc(read, x, y) ? 1 : 0;
    first[static_cast<std::size_t>(y) + 1] = first[static_cast<std::size_t>(y)] + count;
  }
  std::vector<Lookup> all(first.back());
  const auto hemisphere = static_cast<std::uint32_t>(size * size);
  parallel_for(component.height, [&](int y) {
    std::size_t next = first[static_cast<std::size_t>(y)];
    for (int x = 0; x < component.width; ++x) {
      if (!on_disc(read, x, y)) continue;
      const Vec3 w = warp(normal_on_disc(disc_point(disc, x + 0.5, y + 0.5)), slope);
      const Vec2 t = map_of_direction(w);
      const double cx = std::clamp((t.x() + 1) / 2 * size - 0.5, 0.0, size - 1.0);
      const double cy = std::clamp((1 - t.y()) / 2 * size - 0.5, 0.0, size - 1.0);
      const int x0 = std::min(static_cast<int>(cx), size - 2);
      const int y0 = std::min(static_cast<int>(cy), size - 2);
      all[next++] = {static_cast<std::uint32_t>(y0 * size + x0) + (w.z() < 0 ? hemisphere : 0),
                     static_cast<std::uint32_t>(component.index(x, y)), static_cast<float>(cx - x0),
                     static_cast<float>(cy - y0)};
    }
  });
  return all;
}

/// Landweber iterations (simultaneous iterative reconstruction): each texel moves by the weighted mean of the
/// errors of the pixels that read it. Where texels are denser than pixels the errors vanish; elsewhere it is
/// the least squares.
void correct(SphereMap& map, const Image& component, const std::vector<Lookup>& all) {
  using Texel = Eigen::Array4f;  // the fourth channel is idle: four are added at once
  const auto size = static_cast<std::size_t>(map.size());
  const std::array<std::size_t, 4> corner{0, 1, size, size + 1};
  const std::array<Image*, 2> halves{&map.front, &map.back};
  std::vector<Texel> texels(2 * size * size);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const float* p = halves[i / (size * size)]->data.data() + 3 * (i % (size * size));
    texels[i] = {p[0], p[1], p[2], 0};
  }
  std::vector<float> step(texels.size(), 0.0F);
  for (const Lookup& l : all) {
    const auto weights = l.weights();
    for (std::size_t i = 0; i < 4; ++i) step[l.texel + corner[i]] += weights[i];
  }
  for (float& s : step) s = s > 1e-4F ? 1 / std::max(s, 0.25F) : 0;
  std::vector<Texel> change(texels.size(), Texel::Zero());
  for (int round = 0; round < kCorrections; ++round) {
    Texel largest = Texel::Zero();
    for (const Lookup& l : all) {
      const auto weights = l.weights();
      const float* p = component.data.data() + l.pixel;
      Texel error(p[0], p[1], p[2], 0);
      for (std::size_t i = 0; i < 4; ++i) error -= weights[i] * texels[l.texel + corner[i]];
      for (std::size_t i = 0; i < 4; ++i) change[l.texel + corner[i]] += weights[i] * error;
    }
    for (std::size_t i = 0; i < texels.size(); ++i) {
      if (step[i] == 0) continue;
      const Texel move = step[i] * change[i];
      texels[i] += move;
      largest = largest.max(move.abs());
      change[i].setZero();
    }
    if (largest.maxCoeff() < kSmallError) break;
  }
  for (std::size_t i = 0; i < texels.size(); ++i) {
    float* p = halves[i / (size * size)]->data.data() + 3 * (i % (size * size));
    for (Eigen::Index c = 0; c < 3; ++c) p[c] = texels[i][c];
  }
}

}  // namespace

SphereMap unwarp_to_sphere(const Image& component, const Disc& disc, double slope, int size, double rim) {
  const Disc read{disc.x, disc.y, disc.radius - rim};
  const Image picture = continued_past_rim(component, read);
  const double widest = std::asin(read.radius / disc.radius);  // the angle of the last normal that is read
  const auto colour_at = [&](double theta, double azimuth) -> Vec3 {
    const Vec2 p = disc_pixel(disc, std::sin(theta) * Vec2(std::cos(azimuth), std::sin(azimuth)));
    return sample_sharp(picture, p.x(), p.y());
  };
  const BlindSpot blind_spot(kPi - (1 + slope) * widest, [&](double beyond, double azimuth) {
    return colour_at(std::max(0.0, widest - beyond / (1 + slope)), azimuth);
  });
  SphereMap map = make_sphere_map(size, [&](const Vec3& w) -> Vec3 {
    const double across = std::hypot(w.x(), w.y());
    const double theta = std::atan2(across, w.z()) / (1 + slope);
    if (theta > widest) return blind_spot(w);
    if (across == 0) return colour_at(0, 0);
    const Vec2 p = disc_pixel(disc, w.head<2>() * (std::sin(theta) / across));
    return sample_sharp(picture, p.x(), p.y());
  });
  correct(map, component, lookups(component, disc, read, slope, size));
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

}  // namespace sateen::matcap
