// SPDX-License-Identifier: MIT
#include "sateen/capture/frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sateen/core/colour.h"

namespace sateen {
namespace {

/// The pixel above and left of a point, and how far the point lies from it.
struct Corner {
  int x, y;
  float fx, fy;
  bool last_x, last_y;  // there is no pixel beyond it

  Corner(const Vec2f& p, int width, int height) {
    const float cx = std::clamp(p.x() - 0.5f, 0.0f, static_cast<float>(width - 1));
    const float cy = std::clamp(p.y() - 0.5f, 0.0f, static_cast<float>(height - 1));
    x = static_cast<int>(cx);
    y = static_cast<int>(cy);
    fx = cx - static_cast<float>(x);
    fy = cy - static_cast<float>(y);
    last_x = x + 1 == width;
    last_y = y + 1 == height;
  }
};

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
  if (factor == 1) {
    for (std::size_t i = 0; i < sums.size(); ++i, p += 3)
      sums[i] += quarter_[p[0]] + 2 * quarter_[p[1]] + quarter_[p[2]];
    return;
  }
  for (int& sum : sums) {
    for (int u = 0; u < factor; ++u, p += 3) sum += quarter_[p[0]] + 2 * quarter_[p[1]] + quarter_[p[2]];
  }
}

Vec3f Frame::rgb_at(const Vec2f& p) const {
  const Corner at(p, width_, height_);
  if (light_.empty()) {
    const std::uint8_t* top = codes_.data() + offset(at.x, at.y);
    const std::uint8_t* bottom = at.last_y ? top : top + offset(0, 1);
    const std::ptrdiff_t right = at.last_x ? 0 : 3;
    Vec3f result;
    for (int i = 0; i < 3; ++i) {
      const float a = table_[top[i]] + at.fx * (table_[top[i + right]] - table_[top[i]]);
      const float b = table_[bottom[i]] + at.fx * (table_[bottom[i + right]] - table_[bottom[i]]);
      result[i] = a + at.fy * (b - a);
    }
    return result;
  }
  const int x1 = at.last_x ? at.x : at.x + 1;
  const int y1 = at.last_y ? at.y : at.y + 1;
  const Vec3f top = rgb(at.x, at.y) * (1 - at.fx) + rgb(x1, at.y) * at.fx;
  const Vec3f bottom = rgb(at.x, y1) * (1 - at.fx) + rgb(x1, y1) * at.fx;
  return top * (1 - at.fy) + bottom * at.fy;
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
