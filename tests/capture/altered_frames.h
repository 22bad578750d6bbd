// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "capture/simulator.h"
#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/core/colour.h"
#include "sateen/core/image.h"

// Simulated frames changed pixel by pixel, for what the simulator has no knob for.
namespace sateen::test {

/// The light of a frame of code values, 3 channels.
inline Image light_of(const io::Picture8& picture) {
  Image light(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    light.data[i] = srgb_decode(static_cast<float>(picture.rgb[i]) / 255.0f);
  return light;
}

/// Multiplies what shows the sphere by `factor` of the view-space normal there; 3 x 3 samples a pixel.
inline void multiply_sphere(Image& light, const capture::Camera& camera, const capture::SphereView& sphere,
                            const std::function<Vec3(const Vec3& normal)>& factor) {
  constexpr int kFine = 3;
  const Vec2 centre = sphere.centre_pixel(camera);
  const double reach = 1.2 * sphere.radius_pixel(camera) + 2;  // perspective stretches outlines
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      if ((Vec2(x, y) - centre).norm() > reach) continue;
      Vec3 sum(0, 0, 0);
      for (int i = 0; i < kFine * kFine; ++i) {
        Vec3 normal;
        const Vec2 p(x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine);
        sum += capture::normal_at_pixel(camera, sphere, p, normal) ? factor(normal) : Vec3(1, 1, 1);
      }
      const Vec3f mean = (sum / (kFine * kFine)).cast<float>();
      light.set_rgb(x, y, light.rgb(x, y).cwiseProduct(mean));
    }
  }
}

}  // namespace sateen::test
