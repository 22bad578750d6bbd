// SPDX-License-Identifier: MIT
#include "sateen/core/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sateen {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kBrightest = 0.98;   // this share of the pixels is to keep its detail
constexpr double kRange = 1.0 / 256;  // eight stops

std::vector<Vec3> covered_light(const Image& picture) {
  std::vector<Vec3> covered;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double alpha = picture.channels == 4 ? static_cast<double>(picture.at(x, y, 3)) : 1;
      const Vec3 light = picture.rgb(x, y).cast<double>() / alpha;
      if (alpha > 0 && light.allFinite()) covered.push_back(light.cwiseMax(0.0));
    }
  }
  return covered;
}

}  // namespace

double automatic_exposure(const Image& light) {
  const std::vector<Vec3> covered = covered_light(light);
  if (covered.empty()) return 0;
  std::vector<double> peaks(covered.size());
  std::ranges::transform(covered, peaks.begin(), [](const Vec3& v) { return v.maxCoeff(); });
  const auto nth = static_cast<std::ptrdiff_t>(kBrightest * static_cast<double>(peaks.size() - 1));
  std::ranges::nth_element(peaks, peaks.begin() + nth);
  const double bright = peaks[static_cast<std::size_t>(nth)];
  if (bright <= 0) return 0;
  double stops = 0;
  for (const double peak : peaks) stops += std::log2(std::max(peak, bright * kRange));
  stops /= static_cast<double>(covered.size());
  return std::min(std::log2(kMiddleGrey) - stops, -std::log2(bright));
}

}  // namespace sateen
