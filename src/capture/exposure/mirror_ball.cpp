// SPDX-License-Identifier: MIT
#include "sateen/capture/exposure/mirror_ball.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sateen/core/parallel.h"
#include "sateen/light/environment.h"

namespace sateen::capture {

Vec3 mirror_normal(const SphereView& ball, const Vec3& towards) {
  // The half vector of light and eye; the eye's direction depends a little on where the normal is, so it is
  // iterated.
  Vec3 normal = -ball.centre.normalized();
  for (int i = 0; i < 30; ++i) {
    const Vec3 to_eye = -(ball.centre + normal).normalized();
    const Vec3 half = towards + to_eye;
    if (half.norm() < 1e-9) return normal;
    normal = half.normalized();
  }
  return normal;
}

namespace {

/// Directions around the one behind the ball, which nothing shows: rings of means grow inwards and are then
/// made as smooth as what surrounds them (Laplace's equation, by Gauss-Seidel with over-relaxation).
void fill_hidden(Image& map, std::vector<std::uint8_t>& known) {
  const auto at = [&](int x, int y) {
    return pixel_index((x + map.width) % map.width, std::clamp(y, 0, map.height - 1), map.width);
  };
  const auto colour = [&](std::size_t i) { return Eigen::Map<Vec3f>(&map.data[3 * i]); };
  std::vector<std::size_t> hidden;
  for (std::size_t before = known.size(); hidden.size() != before;) {
    before = hidden.size();
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (known[at(x, y)] != 0) continue;
        Vec3f sum(0, 0, 0);
        float n = 0;
        for (const std::size_t i : {at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)}) {
          if (known[i] == 0) continue;
          sum += colour(i);
          ++n;
        }
        if (n == 0) continue;
        colour(at(x, y)) = sum / n;
        hidden.push_back(at(x, y));
      }
    }
    for (std::size_t i = before; i < hidden.size(); ++i) known[hidden[i]] = 1;
  }
  for (int round = 0; round < 200; ++round) {
    for (const std::size_t i : hidden) {
      const int x = static_cast<int>(i) % map.width;
      const int y = static_cast<int>(i) / map.width;
      const Vec3f mean =
          0.25f * (colour(at(x - 1, y)) + colour(at(x + 1, y)) + colour(at(x, y - 1)) + colour(at(x, y + 1)));
      colour(i) += (round < 190 ? 1.8f : 1.0f) * (mean - colour(i));
    }
  }
}

}  // namespace

Image mirror_ball_environment(const Photograph& frame, const Camera& camera, const SphereView& ball,
                              int width, double reflectance) {
  constexpr double kRim = 1.5;  // pixels that mix in what lies behind the ball
  constexpr int kMostSamples = 8;
  const int height = width / 2;
  Image map(width, height, 3);
  std::vector<std::uint8_t> known(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const auto scale = static_cast<float>(1 / reflectance);
  const double radius = ball.radius_pixel(camera);
  const double farthest = 1 - kRim / radius;  // sine of the angle between normal and eye
  // Where the ball faces the camera the map is coarsest: a texel's normals differ by half its width.
  const int n = std::clamp(static_cast<int>(std::ceil(radius * kPi / width / 1.2)), 1, kMostSamples);
  parallel_for(height, [&](int y) {
    std::vector<Vec2f> points;
    for (int x = 0; x < width; ++x) {
      points.clear();
      for (int i = 0; i < n * n; ++i) {
        const int row = i / n;
        const Vec2 texel(x + (i % n + 0.5) / n, y + (row + 0.5) / n);
        const Vec3 normal =
            mirror_normal(ball, light::environment_direction({texel.x() / width, texel.y() / height}));
        const double cosine = normal.dot(-(ball.centre + normal).normalized());
        if (cosine <= 0 || std::sqrt(1 - std::min(1.0, cosine * cosine)) > farthest) continue;
        points.emplace_back(camera.project(ball.centre + normal).cast<float>());
      }
      if (points.empty()) continue;
      map.set_rgb(x, y, scale / static_cast<float>(points.size()) * frame.sum_light(points).head<3>());
      known[pixel_index(x, y, width)] = 1;
    }
  });
  fill_hidden(map, known);
  return map;
}

}  // namespace sateen::capture
