// SPDX-License-Identifier: MIT
#include "sateen/matcap/sharpen.h"

#include <algorithm>
#include <cmath>

#include "sateen/matcap/sphere_blur.h"

namespace sateen::matcap {
namespace {

constexpr double kTexelsOfFilter =
    1.5;  // standard deviations of the filter, in texels at the centre of the coarse map
constexpr float kDark = 1e-3F;  // of white: below, ratios of dark values would be ratios of noise

template <class Function>
void for_each_value(SphereMap& a, const SphereMap& b, const Function& function) {
  for (std::size_t i = 0; i < a.front.data.size(); ++i) {
    a.front.data[i] = function(a.front.data[i], b.front.data[i]);
    a.back.data[i] = function(a.back.data[i], b.back.data[i]);
  }
}

SphereMap shrunk(const SphereMap& map, int size) {
  return {resized(map.front, size, size), resized(map.back, size, size)};
}

}  // namespace

SphereMap sharpened(const SphereMap& map, double variance) {
  if (variance <= 0) return map;
  const int coarse = std::clamp(static_cast<int>(4 * kTexelsOfFilter / std::sqrt(variance)), 16, map.size());
  const SphereMap seen = shrunk(map, coarse);
  SphereMap result = map;
  for_each_value(result, map, [](float v, float) { return std::max(v, 0.0F); });
  for (int round = 0; round < kSharpenRounds; ++round) {
    SphereMap ratio = blurred(shrunk(result, coarse), variance, coarse);
    for_each_value(ratio, seen, [](float predicted, float value) {
      return (std::max(value, 0.0F) + kDark) / (std::max(predicted, 0.0F) + kDark);
    });
    const SphereMap correction = blurred(blurred(ratio, variance, coarse), 0, map.size());
    for_each_value(result, correction, [](float value, float factor) { return value * factor; });
  }
  return result;
}

}  // namespace sateen::matcap
