// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sateen/matcap/sphere_disc.h"

namespace sateen::test {

/// The sphere's pixels of a picture with their normals, in single precision.
struct SpherePixels {
  std::vector<std::size_t> pixel;
  std::vector<float> x, y, z;
};

inline SpherePixels sphere_pixels(int width, int height, const matcap::Disc& disc) {
  SpherePixels result;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!matcap::on_disc(disc, x, y)) continue;
      const Vec2 p = matcap::disc_point(disc, x + 0.5, y + 0.5);
      result.pixel.push_back(static_cast<std::size_t>(y * width + x));
      result.x.push_back(static_cast<float>(p.x()));
      result.y.push_back(static_cast<float>(p.y()));
      result.z.push_back(static_cast<float>(std::sqrt(std::max(0.0, 1 - p.squaredNorm()))));
    }
  }
  return result;
}

/// max over all points of n . point for the directions first, first + stride, ... by trying every point; the
/// loops the compiler vectorises best. -FLT_MAX for the other directions.
#if defined(__x86_64__)
__attribute__((target("avx2")))
#endif
inline std::vector<float>
support_brute_force(const SpherePixels& directions, const std::vector<float>& px,
                    const std::vector<float>& py, const std::vector<float>& pz, std::size_t stride = 1) {
  constexpr std::size_t kWidth = 64;
  std::vector<float> result(directions.x.size(), -FLT_MAX);
  for (std::size_t first = 0; first < result.size(); first += kWidth * stride) {
    float x[kWidth], y[kWidth], z[kWidth], best[kWidth];
    for (std::size_t i = 0; i < kWidth; ++i) {
      const std::size_t at = std::min(first + i, result.size() - 1);
      x[i] = directions.x[at];
      y[i] = directions.y[at];
      z[i] = directions.z[at];
      best[i] = -FLT_MAX;
    }
    for (std::size_t q = 0; q < px.size(); ++q) {
      for (std::size_t i = 0; i < kWidth; ++i) {
        const float product = (x[i] * px[q] + y[i] * py[q]) + z[i] * pz[q];
        best[i] = product > best[i] ? product : best[i];
      }
    }
    for (std::size_t i = 0; i < kWidth && first + i < result.size(); ++i) result[first + i] = best[i];
  }
  return result;
}

/// The definition of cosine_opening (matcap/separation.h) by comparing all pairs of pixels.
inline std::vector<float> opening_brute_force(const std::vector<float>& values,
                                              const std::vector<char>& ignored, int width, int height,
                                              const matcap::Disc& disc) {
  const SpherePixels pixels = sphere_pixels(width, height, disc);
  std::vector<float> x, y, z;
  const auto clear = [&] {
    x.clear();
    y.clear();
    z.clear();
  };
  const auto add = [&](std::size_t i, float s) {
    x.push_back(s * pixels.x[i]);
    y.push_back(s * pixels.y[i]);
    z.push_back(s * pixels.z[i]);
  };
  for (std::size_t i = 0; i < pixels.pixel.size(); ++i) {
    if (ignored.empty() || ignored[pixels.pixel[i]] == 0)
      add(i, 1 / std::max(values[pixels.pixel[i]], 1e-20F));
  }
  std::vector<float> result(values.size(), 0);
  if (x.empty()) return result;
  const std::vector<float> reciprocal = support_brute_force(pixels, x, y, z);
  clear();
  for (std::size_t i = 0; i < pixels.pixel.size(); ++i) {
    if (reciprocal[i] > 0) add(i, 1 / reciprocal[i]);
  }
  if (x.empty()) return result;
  const std::vector<float> dilated = support_brute_force(pixels, x, y, z);
  for (std::size_t i = 0; i < pixels.pixel.size(); ++i) {
    const std::size_t pixel = pixels.pixel[i];
    result[pixel] = std::clamp(dilated[i], 0.0F, std::max(values[pixel], 0.0F));
  }
  return result;
}

}  // namespace sateen::test
