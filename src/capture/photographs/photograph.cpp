// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/photograph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sateen::capture {
namespace {

/// The pixels around points of a picture.
struct Corners {
  Corners(int width, int height)
      : last_x(width - 1), last_y(height - 1), most(static_cast<float>(last_x), static_cast<float>(last_y)) {}

  /// Bilinear between pixel(x, y)'s.
  template <class Pixel>
  Vec4f between(const Vec2f& p, const Pixel& pixel) const {
    const float cx = std::min(std::max(p.x() - 0.5f, 0.0f), most.x());
    const float cy = std::min(std::max(p.y() - 0.5f, 0.0f), most.y());
    const int x = static_cast<int>(cx);
    const int y = static_cast<int>(cy);
    const int right = std::min(x + 1, last_x);
    const int below = std::min(y + 1, last_y);
    const float fx = cx - static_cast<float>(x);
    const float fy = cy - static_cast<float>(y);
    const Vec4f a = pixel(x, y);
    const Vec4f top = a + fx * (pixel(right, y) - a);
    const Vec4f c = pixel(x, below);
    const Vec4f bottom = c + fx * (pixel(right, below) - c);
    return top + fy * (bottom - top);
  }

  int last_x, last_y;
  Vec2f most;
};

}  // namespace

Photograph::Photograph(io::Picture8 picture, const Response& response)
    : width_(picture.width), height_(picture.height), codes_(std::move(picture.rgb)) {
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = response(static_cast<float>(i) / 255.0f);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t code = 0; code < table_.size(); ++code) {
      channel_[c][code] = table_[code] * Vec4f::Unit(static_cast<Eigen::Index>(c));
      channel_[c][code][3] = code >= kClipped ? 1 : 0;
    }
  }
  std::ranges::transform(table_, quarter_.begin(), [](float light) {
    return static_cast<std::uint16_t>(std::lround(0.25f * kWhite * std::clamp(light, 0.0f, 1.0f)));
  });
}

Photograph::Photograph(Image light, float clip)
    : width_(light.width), height_(light.height), light_(std::move(light)), clip_(clip) {}

void Photograph::add_grey_row(int x, int y, int factor, std::span<int> sums) const {
  if (!light_.empty()) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const int first = x + static_cast<int>(i) * factor;
      for (int u = first; u < first + factor; ++u)
        sums[i] += static_cast<int>(std::lround(std::clamp(grey(u, y), 0.0f, 1.0f) * kWhite));
    }
    return;
  }
  const std::uint8_t* p = codes_.data() + offset(x, y);
  if (factor == 1) {
    for (std::size_t i = 0; i < sums.size(); ++i, p += 3)
      sums[i] += quarter_[p[0]] + 2 * quarter_[p[1]] + quarter_[p[2]];
    return;
  }
  for (int& sum : sums) {
    for (int u = 0; u < factor; ++u, p += 3) sum += quarter_[p[0]] + 2 * quarter_[p[1]] + quarter_[p[2]];
  }
}

Vec4f Photograph::sum_light(std::span<const Vec2f> points) const {
  const Corners corners(width_, height_);
  Vec4f sum = Vec4f::Zero();
  if (!light_.empty()) {
    for (const Vec2f& p : points) {
      sum += corners.between(p, [&](int x, int y) -> Vec4f {
        const Vec3f light = light_.rgb(x, y);
        return {light[0], light[1], light[2], clipped(x, y) ? 1.0f : 0.0f};
      });
    }
    return sum;
  }
  constexpr float kUnbounded = std::numeric_limits<float>::max();
  const Vec4f most(kUnbounded, kUnbounded, kUnbounded, 1);
  for (const Vec2f& p : points) {
    sum += corners.between(p, [&](int x, int y) -> Vec4f {
      const std::uint8_t* code = codes_.data() + offset(x, y);
      return (channel_[0][code[0]] + channel_[1][code[1]] + channel_[2][code[2]]).cwiseMin(most);
    });
  }
  return sum;
}

io::Picture8 Photograph::take_codes() {
  return {std::exchange(width_, 0), std::exchange(height_, 0), std::move(codes_)};
}

}  // namespace sateen::capture
