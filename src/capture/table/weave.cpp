// SPDX-License-Identifier: MIT
#include "sateen/capture/table/weave.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::capture {
namespace {

using Terms = Eigen::Matrix<double, 10, 1>;

/// The terms of a cubic in a body point.
Terms cubic(const Vec2& p) {
  const double x = p.x();
  const double y = p.y();
  Terms terms;
  terms << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return terms;
}

/// The middle of the table, half as wide as all of it: where threads are seen head-on.
class Middle {
 public:
  explicit Middle(const RectifiedStack& stack)
      : stack_(stack), width_(cv::getOptimalDFTSize(stack.size / 2)), corner_((stack.size - width_) / 2) {
    // Texels are sines in the eye frame, body points in the axis frame: a cubic leads from the one to the
    // other to a small part of a texel.
    const AxisFrame axes(stack.axis);
    const auto count = static_cast<Eigen::Index>(width_) * width_;
    Eigen::Matrix<double, Eigen::Dynamic, 10> terms(count, 10);
    Eigen::Matrix<double, Eigen::Dynamic, 2> texels(count, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto x = static_cast<int>(i % width_) + corner_;
      const auto y = static_cast<int>(i / width_) + corner_;
      const Vec3& normal = stack.points[pixel_index(x, y, stack.size)].normal;
      const Vec2 body = body_point(axes, normal, direction_of(0));
      terms.row(i) = cubic(body).transpose();
      texels.row(i) << x, y;
    }
    to_texel_ = terms.householderQr().solve(texels);
  }

  int width() const { return width_; }

  /// The detail that turns with the body, at angle 0: the mean of all frames. Sensor noise averages out, and
  /// what stands still (shading, the lens) is taken off first.
  cv::Mat turning_detail() const {
    const std::size_t texels = stack_.points.size();
    const std::size_t frames = stack_.frames.size();
    std::vector<std::vector<float>> light(frames, std::vector<float>(texels));
    std::vector<float> still(texels, 0);
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t i = 0; i < texels; ++i) {
        const auto green = static_cast<float>(stack_.frames[f].rgb[i * 3 + 1]);
        light[f][i] = std::log(std::max(0.0f, green) + 1e-3f);
        still[i] += light[f][i] / static_cast<float>(frames);
      }
    }
    cv::Mat detail(width_, width_, CV_32F);
    const int size = stack_.size;
    parallel_for(width_, [&](int row) {
      for (int column = 0; column < width_; ++column) {
        const double per_texel = 2.0 / size;
        const Vec2 body = per_texel * Vec2(column + 0.5 - width_ / 2.0, width_ / 2.0 - row - 0.5);
        float sum = 0;
        float count = 0;
        for (std::size_t f = 0; f < frames; ++f) {
          const Vec2 turned = direction_of(stack_.angles[f]);
          const Vec2 seen(turned.x() * body.x() - turned.y() * body.y(),
                          turned.y() * body.x() + turned.x() * body.y());
          const Vec2 at = to_texel_.transpose() * cubic(seen);
          const int x = static_cast<int>(at.x());
          const int y = static_cast<int>(at.y());
          if (at.x() < 0 || at.y() < 0 || x + 1 >= size || y + 1 >= size) continue;
          const auto i = pixel_index(x, y, size);
          const std::size_t below = i + static_cast<std::size_t>(size);
          const std::vector<std::uint8_t>& weight = stack_.frames[f].weight;
          if (weight[i] == 0 || weight[i + 1] == 0 || weight[below] == 0 || weight[below + 1] == 0) continue;
          const auto value = [&](std::size_t t) { return light[f][t] - still[t]; };
          const auto fx = static_cast<float>(at.x() - x);
          const auto fy = static_cast<float>(at.y() - y);
          sum += (1 - fy) * ((1 - fx) * value(i) + fx * value(i + 1)) +
                 fy * ((1 - fx) * value(below) + fx * value(below + 1));
          ++count;
        }
        detail.at<float>(row, column) = count > 0 ? sum / count : 0;
      }
    });
    return detail;
  }

 private:
  const RectifiedStack& stack_;
  int width_;
  int corner_;
  Eigen::Matrix<double, 10, 2> to_texel_;
};

/// Power of a picture's ripples, the one of frequency (x, y) at row and column (y, x) modulo the width.
cv::Mat power_spectrum(const cv::Mat& picture) {
  const int n = picture.cols;
  cv::Mat windowed = picture - cv::mean(picture);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const double hann =
          (0.5 - 0.5 * std::cos(2 * kPi * (y + 0.5) / n)) * (0.5 - 0.5 * std::cos(2 * kPi * (x + 0.5) / n));
      windowed.at<float>(y, x) *= static_cast<float>(hann);
    }
  }
  cv::Mat spectrum;
  cv::dft(windowed, spectrum, cv::DFT_COMPLEX_OUTPUT);
  cv::Mat power(n, n, CV_64F);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const cv::Vec2f value = spectrum.at<cv::Vec2f>(y, x);
      power.at<double>(y, x) = static_cast<double>(value[0] * value[0] + value[1] * value[1]);
    }
  }
  return power;
}

}  // namespace

bool weave_direction(const RectifiedStack& stack, double& direction) {
  const Middle middle(stack);
  const int n = middle.width();
  const cv::Mat power = power_spectrum(middle.turning_detail());
  const auto at = [&](int x, int y) { return power.at<double>((y + n) % n, (x + n) % n); };
  // With the neighbours over which the window spreads a single ripple.
  const auto around = [&](int x, int y) {
    double sum = 0;
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) sum += at(x + u, y + v) / 9;
    }
    return sum;
  };
  // A weave is periodic: one ripple stands out among those of its own frequency, whereas the power of grain
  // is spread over all of them. Slower ripples are shading, faster ones are beyond the texels' own filter.
  const int lowest = n / 8;
  const int highest = static_cast<int>(n / 2.2);
  std::vector<double> ring(static_cast<std::size_t>(highest) + 1, 0);
  std::vector<int> count(ring.size(), 0);
  const auto for_ripples = [&](const auto& body) {
    for (int y = 0; y <= highest; ++y) {
      for (int x = y == 0 ? 1 : -highest; x <= highest; ++x) {
        const auto frequency = static_cast<int>(std::lround(std::hypot(x, y)));
        if (frequency >= lowest && frequency <= highest) body(x, y, static_cast<std::size_t>(frequency));
      }
    }
  };
  for_ripples([&](int x, int y, std::size_t frequency) {
    ring[frequency] += at(x, y);
    ++count[frequency];
  });
  double best = 0;
  Eigen::Vector2i peak(0, 0);
  for_ripples([&](int x, int y, std::size_t frequency) {
    const double stands_out = around(x, y) / std::max(1e-30, ring[frequency] / count[frequency]);
    if (stands_out <= best) return;
    best = stands_out;
    peak = {x, y};
  });
  constexpr double kClear = 12;  // grain of cloth and sensor reached 5.5, weaves beside it 180
  if (best < kClear) return false;
  Vec2 sum(0, 0);
  for (int v = -2; v <= 2; ++v) {
    for (int u = -2; u <= 2; ++u) sum += at(peak.x() + u, peak.y() + v) * Vec2(peak.x() + u, peak.y() + v);
  }
  // Rows run down; threads lie across the ripple they make.
  direction = wrap(std::atan2(-sum.y(), sum.x()) / kPi + 0.5) * kPi;
  return true;
}

}  // namespace sateen::capture
