// SPDX-License-Identifier: MIT
#include "sateen/capture/weave.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "sateen/core/direction.h"

namespace sateen {

bool weave_direction(const RectifiedStack& stack, double& direction) {
  // Power of the middle's light by direction of the ripple, each frame's turned back. What stands still
  // smears out.
  constexpr int kBins = 180;
  std::vector<double> power(kBins, 0);
  const int size = stack.size;
  const int window = cv::getOptimalDFTSize(size / 2);
  const int corner = (size - window) / 2;
  for (std::size_t f = 0; f < stack.frames.size(); ++f) {
    cv::Mat light(window, window, CV_32F);
    for (int y = 0; y < window; ++y) {
      for (int x = 0; x < window; ++x) {
        const auto i = static_cast<std::size_t>((y + corner) * size + x + corner);
        light.at<float>(y, x) =
            std::log(std::max(0.0f, static_cast<float>(stack.frames[f].rgb[i * 3 + 1])) + 1e-3f);
      }
    }
    light -= cv::mean(light);
    for (int y = 0; y < window; ++y) {
      for (int x = 0; x < window; ++x) {
        const double hann = (0.5 - 0.5 * std::cos(2 * kPi * (y + 0.5) / window)) *
                            (0.5 - 0.5 * std::cos(2 * kPi * (x + 0.5) / window));
        light.at<float>(y, x) *= static_cast<float>(hann);
      }
    }
    cv::Mat spectrum;
    cv::dft(light, spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (int y = 0; y < window; ++y) {
      for (int x = 0; x < window; ++x) {
        const int fx = x <= window / 2 ? x : x - window;
        const int fy = y <= window / 2 ? y : y - window;
        const double frequency = std::hypot(fx, fy);
        // Slower ripples are shading, faster ones are beyond the texels' own filter.
        if (frequency < window / 8.0 || frequency > window / 2.2) continue;
        const cv::Vec2f value = spectrum.at<cv::Vec2f>(y, x);
        const double angle = std::atan2(-fy, fx) - stack.angles[f];
        const auto bin = static_cast<std::size_t>(wrap(angle / kPi) * kBins);
        power[std::min(bin, power.size() - 1)] +=
            static_cast<double>(value[0] * value[0] + value[1] * value[1]) / frequency;
      }
    }
  }
  // Smoothed over a few degrees, the peak has to stand clearly above the middle of all directions.
  std::vector<double> smooth(kBins, 0);
  for (int b = 0; b < kBins; ++b) {
    for (int d = -3; d <= 3; ++d) {
      smooth[static_cast<std::size_t>(b)] +=
          (4 - std::abs(d)) / 16.0 * power[static_cast<std::size_t>((b + d + kBins) % kBins)];
    }
  }
  const auto peak = static_cast<int>(std::ranges::max_element(smooth) - smooth.begin());
  std::vector<double> sorted = smooth;
  std::ranges::sort(sorted);
  if (smooth[static_cast<std::size_t>(peak)] < 2 * sorted[kBins / 2]) return false;
  double sum = 0;
  double moment = 0;
  for (int d = -4; d <= 4; ++d) {
    const double above =
        std::max(0.0, smooth[static_cast<std::size_t>((peak + d + kBins) % kBins)] - sorted[kBins / 2]);
    sum += above;
    moment += above * d;
  }
  direction = wrap((peak + 0.5 + moment / sum) / kBins + 0.5) * kPi;
  return true;
}

}  // namespace sateen
