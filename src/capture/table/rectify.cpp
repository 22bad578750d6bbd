// SPDX-License-Identifier: MIT
#include "sateen/capture/table/rectify.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

constexpr int kMostSamples = 8;  // across a texel

}  // namespace

RectifyMap::RectifyMap(const Camera& camera, const SphereView& mean, int size, TableFrame frame,
                       double rim_pixels)
    : size_(size), frame_(frame), centre_(mean.centre_pixel(camera)) {
  const double radius = mean.radius_pixel(camera);
  const double footprint = 2 * radius / size;
  // Bilinear samples reach a pixel: one for each pixel and a half of the footprint leaves no gaps.
  samples_ = std::clamp(static_cast<int>(std::ceil(footprint / 1.2)), 2, kMostSamples);
  const int fine = size * samples_;
  const double visible_reach = 1 - rim_pixels / radius;
  const SphereView right = sphere_at(camera, centre_ + Vec2(1, 0), radius);
  const SphereView down = sphere_at(camera, centre_ + Vec2(0, 1), radius);
  grid_.resize(static_cast<std::size_t>(fine) * static_cast<std::size_t>(fine));
  points_.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  parallel_for(fine, [&](int y) {
    for (int x = 0; x < fine; ++x) {
      Sample& sample = grid_[pixel_index(x, y, fine)];
      const Vec2 disc = disc_of_pixel(x, y, fine);
      sample = {};
      if (disc.norm() >= 1) continue;
      const SeenPoint point = point_of_disc(mean, disc, frame);
      // Distance from the outline in sines of the angle to the view ray: what the eye frame's disc is made
      // of.
      const double cosine = point.normal.dot(point.towards_eye);
      if (!point.visible || std::sqrt(std::max(0.0, 1 - cosine * cosine)) > visible_reach || cosine <= 0)
        continue;
      const Vec2 p = camera.project(mean.centre + point.normal);
      const Vec2 dx = camera.project(right.centre + point_of_disc(right, disc, frame).normal) - p;
      const Vec2 dy = camera.project(down.centre + point_of_disc(down, disc, frame).normal) - p;
      sample = {static_cast<float>(p.x()),
                static_cast<float>(p.y()),
                static_cast<float>(dx.x()),
                static_cast<float>(dx.y()),
                static_cast<float>(dy.x()),
                static_cast<float>(dy.y()),
                true};
    }
  });
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      points_[pixel_index(x, y, size)] = point_of_disc(mean, disc_of_pixel(x, y, size), frame);
    }
  });
}

PixelRect RectifyMap::region(std::span<const Vec2> centres, int width, int height) const {
  const Vec2f first = (centres[0] - centre_).cast<float>();
  Eigen::AlignedBox2f shifts(first);
  for (const Vec2& centre : centres) shifts.extend(Vec2f((centre - centre_).cast<float>()));
  Eigen::AlignedBox2f reach;
  for (const Sample& sample : grid_) {
    if (!sample.seen) continue;
    for (const auto corner : {Eigen::AlignedBox2f::BottomLeft, Eigen::AlignedBox2f::BottomRight,
                              Eigen::AlignedBox2f::TopLeft, Eigen::AlignedBox2f::TopRight})
      reach.extend(sample.moved(shifts.corner(corner)));
  }
  // Bilinear samples touch the pixel before and behind. Some may lie outside of the picture.
  const auto inside = [](float at, int end) { return std::clamp(static_cast<int>(std::floor(at)), 0, end); };
  const int left = inside(reach.min().x() - 1, width - 1);
  const int top = inside(reach.min().y() - 1, height - 1);
  return {left, top, inside(reach.max().x() + 2, width) - left, inside(reach.max().y() + 2, height) - top};
}

RectifiedFrame rectify(const RectifyMap& map, const Photograph& frame, const Vec2& centre, const Vec3& gain) {
  const int size = map.size_;
  const int n = map.samples_;
  const int fine = size * n;
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const Vec2f shift = (centre - map.centre_).cast<float>();
  const Vec3f scale = gain.cwiseInverse().cast<float>();
  std::array<Vec2f, kMostSamples * kMostSamples> points;
  const bool masked = map.mask_.width > 0;
  RectifiedFrame result;
  result.size = size;
  result.rgb.resize(texels * 3);
  result.weight.assign(texels, 0);
  result.clipped.assign(texels, 0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      std::size_t seen = 0;
      for (int v = 0; v < n; ++v) {
        const RectifyMap::Sample* row = map.grid_.data() + pixel_index(x * n, y * n + v, fine);
        for (int u = 0; u < n; ++u) {
          const RectifyMap::Sample& s = row[u];
          if (!s.seen) continue;
          const Vec2f p = s.moved(shift);
          if (masked && map.mask_.hides(p.x(), p.y())) continue;
          points[seen++] = p;
        }
      }
      if (seen == 0) continue;
      const auto i = pixel_index(x, y, size);
      const Vec4f mean = frame.sum_light(std::span(points).first(seen)) / static_cast<float>(seen);
      for (int c = 0; c < 3; ++c)
        result.rgb[i * 3 + static_cast<std::size_t>(c)] =
            static_cast<Half>(std::max(0.0f, mean[c] * scale[c]));
      result.weight[i] = static_cast<std::uint8_t>(255 * static_cast<int>(seen) / (n * n));
      result.clipped[i] = static_cast<std::uint8_t>(255 * mean[3]);
    }
  }
  return result;
}

}  // namespace sateen::capture
