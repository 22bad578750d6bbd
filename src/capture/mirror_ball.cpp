// SPDX-License-Identifier: MIT
#include "sateen/capture/mirror_ball.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen {

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

Image mirror_ball_environment(const Frame& frame, const Camera& camera, const SphereView& ball, int width,
                              double reflectance) {
  const int height = width / 2;
  Image map(width, height, 3);
  std::vector<std::uint8_t> known(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const auto scale = static_cast<float>(1 / reflectance);
  parallel_for(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double longitude = 2 * kPi * ((x + 0.5) / width - 0.5);
      const double latitude = kPi * (0.5 - (y + 0.5) / height);
      const Vec3 towards(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                         -std::cos(latitude) * std::cos(longitude));
      const Vec3 normal = mirror_normal(ball, towards);
      const Vec3 to_eye = -(ball.centre + normal).normalized();
      // At the very rim the picture mixes in what lies behind.
      if (normal.dot(to_eye) < 0.06) continue;
      const Vec2 p = camera.project(ball.centre + normal);
      const std::array at{Vec2f(p.cast<float>())};
      map.set_rgb(x, y, scale * frame.sum_light(at).head<3>());
      known[static_cast<std::size_t>(y * width + x)] = 1;
    }
  });
  // Around the direction behind the ball: rings of means grow inwards.
  for (bool more = true; more;) {
    more = false;
    std::vector<std::pair<std::size_t, Vec3f>> grown;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (known[static_cast<std::size_t>(y * width + x)] != 0) continue;
        Vec3f sum(0, 0, 0);
        float n = 0;
        for (int v = -1; v <= 1; ++v) {
          for (int u = -1; u <= 1; ++u) {
            const int ny = std::clamp(y + v, 0, height - 1);
            const int nx = (x + u + width) % width;
            if (known[static_cast<std::size_t>(ny * width + nx)] == 0) continue;
            sum += map.rgb(nx, ny);
            ++n;
          }
        }
        if (n > 0) grown.emplace_back(static_cast<std::size_t>(y * width + x), sum / n);
      }
    }
    for (const auto& [i, colour] : grown) {
      map.set_rgb(static_cast<int>(i) % width, static_cast<int>(i) / width, colour);
      known[i] = 1;
      more = true;
    }
  }
  return map;
}

}  // namespace sateen
