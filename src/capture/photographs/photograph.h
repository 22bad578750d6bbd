// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sateen/capture/photographs/response.h"
#include "sateen/core/image.h"
#include "sateen/io/picture8.h"

namespace sateen::capture {

/// One picture of a capture: 8-bit code values with the response that makes them light, or light itself.
/// Made once and then read by one thread or many.
class Photograph {
 public:
  Photograph() = default;
  Photograph(io::Picture8 picture, const Response& response);
  /// `clip`: the value from which on a sample counts as clipped.
  Photograph(Image light, float clip);

  int width() const { return width_; }
  int height() const { return height_; }

  Vec3f rgb(int x, int y) const {
    if (light_.empty()) {
      const std::uint8_t* p = codes_.data() + offset(x, y);
      return {table_[p[0]], table_[p[1]], table_[p[2]]};
    }
    return light_.rgb(x, y);
  }
  /// (R + 2 G + B) / 4: all that finding and registering needs.
  float grey(int x, int y) const {
    const Vec3f c = rgb(x, y);
    return 0.25f * (c[0] + 2 * c[1] + c[2]);
  }
  bool clipped(int x, int y) const {
    if (light_.empty()) {
      const std::uint8_t* p = codes_.data() + offset(x, y);
      return p[0] >= kClipped || p[1] >= kClipped || p[2] >= kClipped;
    }
    return light_.rgb(x, y).maxCoeff() >= clip_;
  }
  /// The sum over `points` of the light (R, G, B) there, bilinear, clamped to the edge, pixel centres at
  /// +0.5; fourth, of how much of it is clipped, 0 to 1 each.
  Vec4f sum_light(std::span<const Vec2f> points) const;

  /// Adds to each sum the grey() of `factor` pixels of row y, from pixel (x, y) on: sums[i] gets those of
  /// x + i * factor and the factor - 1 after it. kWhite is white.
  void add_grey_row(int x, int y, int factor, std::span<int> sums) const;
  static constexpr int kWhite = 65532;

  /// Takes the code values out, for their memory's sake; the frame is empty then.
  io::Picture8 take_codes();

 private:
  static constexpr int kClipped = 254;  // code from which on a channel counts as clipped

  std::size_t offset(int x, int y) const { return 3 * pixel_index(x, y, width_); }

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> codes_;
  std::array<float, 256> table_{};
  std::array<std::array<Vec4f, 256>, 3> channel_{};  // table_ as one channel of sum_light's; does it clip
  std::array<std::uint16_t, 256> quarter_{};         // table_ in quarters of kWhite
  Image light_;
  float clip_ = 1;
};

}  // namespace sateen::capture
