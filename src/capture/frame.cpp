// SPDX-License-Identifier: MIT
#include "sateen/capture/frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sateen/core/colour.h"

namespace sateen {
namespace {

/// The four pixels around a point and their weights.
struct Corners {
  int x0, y0, x1, y1;
  float fx, fy;
};

Corners corners(double x, double y, int width, int height) {
  const double cx = std::clamp(x - 0.5, 0.0, width - 1.0);
  const double cy = std::clamp(y - 0.5, 0.0, height - 1.0);
  const int x0 = static_cast<int>(cx);
  const int y0 = static_cast<int>(cy);
  return {x0,
          y0,
          std::min(x0 + 1, width - 1),
          std::min(y0 + 1, height - 1),
          static_cast<float>(cx - x0),
          static_cast<float>(cy - y0)};
}

}  // namespace

Response Response::srgb() {
  Response response;
  for (int i = 0; i < 4096; ++i) response.curve.push_back(srgb_decode(static_cast<float>(i) / 4095.0f));
  return response;
}

Response Response::linear() {
  return {{0, 1}};
}

Response Response::gamma(double exponent) {
  Response response;
  for (int i = 0; i < 4096; ++i) {
    response.curve.push_back(static_cast<float>(std::pow(i / 4095.0, exponent)));
  }
  return response;
}

float Response::operator()(float code) const {
  const float at = std::clamp(code, 0.0f, 1.0f) * static_cast<float>(curve.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), curve.size() - 2);
  const float f = at - static_cast<float>(i);
  return curve[i] + f * (curve[i + 1] - curve[i]);
}

Frame::Frame(Picture8 picture, const Response& response)
    : width_(picture.width), height_(picture.height), codes_(std::move(picture.rgb)) {
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = response(static_cast<float>(i) / 255.0f);
  std::ranges::transform(table_, quarter_.begin(), [](float light) {
    return static_cast<std::uint16_t>(std::clamp(light, 0.0f, 1.0f) * (kWhite / 4) + 0.5f);
  });
}

Frame::Frame(Image light, float clip)
    : width_(light.width), height_(light.height), light_(std::move(light)), clip_(clip) {}

void Frame::add_grey_row(int x, int y, int factor, std::span<int> sums) const {
  if (!light_.empty()) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const int first = x + static_cast<int>(i) * factor;
      for (int u = first; u < first + factor; ++u)
        sums[i] += static_cast<int>(std::clamp(grey(u, y), 0.0f, 1.0f) * kWhite + 0.5f);
    }
    return;
  }
  const std::uint8_t* p = codes_.data() + offset(x, y);
  for (int& sum : sums) {
    for (int u = 0; u < factor; ++u, p += 3) sum += quarter_[p[0]] + 2 * quarter_[p[1]] + quarter_[p[2]];
  }
}

Vec3f Frame::rgb_at(double x, double y) const {
  const Corners c = corners(x, y, width_, height_);
  if (light_.empty()) {
    const std::uint8_t* top = codes_.data() + offset(c.x0, c.y0);
    const std::uint8_t* bottom = codes_.data() + offset(c.x0, c.y1);
    const std::ptrdiff_t right = 3 * (c.x1 - c.x0);
    Vec3f result;
    for (int i = 0; i < 3; ++i) {
      const float a = table_[top[i]] + c.fx * (table_[top[i + right]] - table_[top[i]]);
      const float b = table_[bottom[i]] + c.fx * (table_[bottom[i + right]] - table_[bottom[i]]);
      result[i] = a + c.fy * (b - a);
    }
    return result;
  }
  const Vec3f top = rgb(c.x0, c.y0) * (1 - c.fx) + rgb(c.x1, c.y0) * c.fx;
  const Vec3f bottom = rgb(c.x0, c.y1) * (1 - c.fx) + rgb(c.x1, c.y1) * c.fx;
  return top * (1 - c.fy) + bottom * c.fy;
}

Picture8 Frame::take_codes() {
  return {std::exchange(width_, 0), std::exchange(height_, 0), std::move(codes_)};
}

Image Frame::crop(int x0, int y0, int width, int height) const {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, rgb(x0 + x, y0 + y));
  }
  return image;
}

}  // namespace sateen
