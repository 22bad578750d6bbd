// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen {

/// Where pixel (x, y) of a picture stands, counted row by row.
inline std::size_t pixel_index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// A picture in memory: linear, scene-referred light (Rec. 709 primaries) or plain data (normals, roughness),
/// as floats. io/ converts from and to what files hold; nothing in memory is sRGB unless its name says so.
///
/// Row-major and interleaved: channel c of pixel (x, y) is data[(y * width + x) * channels + c]; row 0 is the
/// top row.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> data;

  Image() = default;
  Image(int width, int height, int channels, float value = 0);

  bool empty() const { return data.empty(); }
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);  // in unoptimised and sanitizer builds
    return pixel_index(x, y, width) * static_cast<std::size_t>(channels);
  }
  float& at(int x, int y, int c) { return data[index(x, y) + static_cast<std::size_t>(c)]; }
  float at(int x, int y, int c) const { return data[index(x, y) + static_cast<std::size_t>(c)]; }
  std::span<float> pixel(int x, int y) {
    return {data.data() + index(x, y), static_cast<std::size_t>(channels)};
  }
  std::span<const float> pixel(int x, int y) const {
    return {data.data() + index(x, y), static_cast<std::size_t>(channels)};
  }

  /// The first three channels of a pixel; a grey picture repeats its only channel.
  Vec3f rgb(int x, int y) const {
    const float* p = data.data() + index(x, y);
    return channels >= 3 ? Vec3f(p[0], p[1], p[2]) : Vec3f(p[0], p[0], p[0]);
  }
  void set_rgb(int x, int y, const Vec3f& value) {
    float* p = data.data() + index(x, y);
    for (int c = 0; c < std::min(channels, 3); ++c) p[c] = value[c];
  }
};

/// A rectangle of pixels, from the top left corner of a picture.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Whether a region holds at least one pixel and lies inside a width x height picture.
bool fits(const PixelRect& region, int width, int height);

/// The part of a region inside a width x height picture; empty where they do not meet, whatever the numbers.
PixelRect overlap(const PixelRect& region, int width, int height);

/// The pixels of a region that fits.
Image cropped(const Image& image, const PixelRect& region);

/// The same picture with exactly `channels` channels: grey is repeated, a missing fourth channel is 1, others
/// are cut.
Image with_channels(const Image& image, int channels);

/// Area-filtered change of size (each output pixel is the mean of the input area it covers) when shrinking,
/// bilinear when enlarging; the axes are treated separately. Exact for constant pictures.
Image resized(const Image& image, int width, int height);

/// Bilinear sample at continuous pixel coordinates (pixel centres at +0.5), clamped to the edge; `out` has
/// image.channels entries.
void sample_bilinear(const Image& image, double x, double y, std::span<double> out);

}  // namespace sateen
