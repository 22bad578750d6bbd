// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include "sateen/core/image.h"
#include "sateen/light/environment.h"

// A picture of surroundings, and the brute force that tells what a surface reflects of it.
namespace sateen::test {

/// A soft sky: bright above, a window to the upper left, a warm floor.
inline Image sky(int width = 128) {
  Image image(width, width / 2, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec3 d = light::environment_direction({(x + 0.5) / image.width, (y + 0.5) / image.height});
      const double window = std::exp(8 * (d.dot(Vec3(-0.6, 0.5, 0.6).normalized()) - 1));
      const Vec3 light = Vec3(0.3, 0.35, 0.45) * (1 + d.y()) / 2 + Vec3(0.12, 0.08, 0.05) * (1 - d.y()) / 2 +
                         window * Vec3(1.0, 0.9, 0.8);
      image.set_rgb(x, y, light.cast<float>());
    }
  }
  return image;
}

/// Radiance towards `view` in the sky by plain summation: f (n.u) L over the hemisphere.
inline Vec3 summed(const std::function<Vec3(const Vec3&)>& brdf, const Image& light) {
  constexpr int kSteps = 160;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) / kSteps;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < 2 * kSteps; ++j) {
      const double phi = kPi * (j + 0.5) / kSteps;
      const Vec3 u(r * std::cos(phi), r * std::sin(phi), z);
      sum += brdf(u).cwiseProduct(light::environment_radiance(light, u)) * z;
    }
  }
  return sum * (kPi / (kSteps * kSteps));
}

}  // namespace sateen::test
