// SPDX-License-Identifier: MIT
#include "sateen/core/image.h"

#include <algorithm>
#include <cmath>

#include "sateen/core/parallel.h"

namespace sateen {
namespace {

/// The input pixels, first .. first + weights.size(), that one output pixel averages along an axis.
struct Footprint {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Footprint> footprints(int from, int to) {
  std::vector<Footprint> result(static_cast<std::size_t>(to));
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Footprint& footprint = result[static_cast<std::size_t>(i)];
    if (scale >= 1) {
      const double begin = i * scale;
      const double end = (i + 1) * scale;
      footprint.first = static_cast<int>(begin);
      const int last = std::min(from, static_cast<int>(std::ceil(end - 1e-9)));
      for (int x = footprint.first; x < last; ++x) {
        const double covered = std::min(end, x + 1.0) - std::max(begin, static_cast<double>(x));
        footprint.weights.push_back(static_cast<float>(covered / scale));
      }
    } else {
      const double centre = std::clamp((i + 0.5) * scale - 0.5, 0.0, from - 1.0);
      footprint.first = std::min(static_cast<int>(centre), std::max(0, from - 2));
      const double fraction = centre - footprint.first;
      footprint.weights = {static_cast<float>(1 - fraction)};
      if (from > 1) footprint.weights.push_back(static_cast<float>(fraction));
    }
  }
  return result;
}

/// One row of `image` averaged into the same row of `narrow`. kChannels lets the compiler keep sums in
/// registers; 0 is any number.
template <int kChannels>
void resize_row(const Image& image, const std::vector<Footprint>& columns, int y, Image& narrow) {
  const std::size_t channels = static_cast<std::size_t>(kChannels > 0 ? kChannels : image.channels);
  for (int x = 0; x < narrow.width; ++x) {
    const Footprint& column = columns[static_cast<std::size_t>(x)];
    const float* in = image.data.data() + image.index(column.first, y);
    float* out = narrow.data.data() + narrow.index(x, y);
    for (const float weight : column.weights) {
      for (std::size_t c = 0; c < channels; ++c) out[c] += weight * in[c];
      in += channels;
    }
  }
}

}  // namespace

Image::Image(int width_, int height_, int channels_, float value)
    : width(width_),
      height(height_),
      channels(channels_),
      data(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
               static_cast<std::size_t>(channels_),
           value) {}

bool fits(const PixelRect& region, int width, int height) {
  return region.x >= 0 && region.y >= 0 && region.width > 0 && region.height > 0 &&
         region.width <= width - region.x && region.height <= height - region.y;
}

PixelRect overlap(const PixelRect& region, int width, int height) {
  const auto part = [](int begin, int length, int most) {
    const long long end = std::min<long long>(most, static_cast<long long>(begin) + length);
    const long long first = std::clamp<long long>(begin, 0, most);
    return std::pair{static_cast<int>(first), static_cast<int>(std::max(0LL, end - first))};
  };
  const auto [x, columns] = part(region.x, region.width, width);
  const auto [y, rows] = part(region.y, region.height, height);
  return {x, y, columns, rows};
}

Image cropped(const Image& image, const PixelRect& region) {
  Image result(region.width, region.height, image.channels);
  const auto columns = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(image.channels);
  for (int y = 0; y < region.height; ++y) {
    const float* row = image.data.data() + image.index(region.x, region.y + y);
    std::copy_n(row, columns, result.data.data() + result.index(0, y));
  }
  return result;
}

Image with_channels(const Image& image, int channels) {
  if (channels == image.channels) return image;
  Image result(image.width, image.height, channels, 1);
  const bool grey = image.channels < 3;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto in = image.pixel(x, y);
      const auto out = result.pixel(x, y);
      for (std::size_t c = 0; c < out.size(); ++c) {
        if (grey && c < 3) {
          out[c] = in[0];
        } else if (c == 3 && image.channels == 2) {
          out[c] = in[1];
        } else if (c < in.size()) {
          out[c] = in[c];
        }
      }
    }
  }
  return result;
}

Image resized(const Image& image, int width, int height) {
  if (width == image.width && height == image.height) return image;
  const auto columns = footprints(image.width, width);
  const auto rows = footprints(image.height, height);
  Image narrow(width, image.height, image.channels);
  parallel_for(image.height, [&](int y) {
    switch (image.channels) {
      case 1:
        return resize_row<1>(image, columns, y, narrow);
      case 3:
        return resize_row<3>(image, columns, y, narrow);
      case 4:
        return resize_row<4>(image, columns, y, narrow);
      default:
        return resize_row<0>(image, columns, y, narrow);
    }
  });
  Image result(width, height, image.channels);
  parallel_for(height, [&](int y) {
    const Footprint& row = rows[static_cast<std::size_t>(y)];
    float* out = result.data.data() + result.index(0, y);
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < row.weights.size(); ++i) {
      const float* in = narrow.data.data() + narrow.index(0, row.first + static_cast<int>(i));
      for (std::size_t j = 0; j < n; ++j) out[j] += row.weights[i] * in[j];
    }
  });
  return result;
}

void sample_bilinear(const Image& image, double x, double y, std::span<double> out) {
  const double cx = std::clamp(x - 0.5, 0.0, image.width - 1.0);
  const double cy = std::clamp(y - 0.5, 0.0, image.height - 1.0);
  const int x0 = static_cast<int>(cx);
  const int y0 = static_cast<int>(cy);
  const int x1 = std::min(x0 + 1, image.width - 1);
  const int y1 = std::min(y0 + 1, image.height - 1);
  const double fx = cx - x0;
  const double fy = cy - y0;
  const auto a = image.pixel(x0, y0);
  const auto b = image.pixel(x1, y0);
  const auto c = image.pixel(x0, y1);
  const auto d = image.pixel(x1, y1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double top = a[i] + fx * (static_cast<double>(b[i]) - a[i]);
    const double bottom = c[i] + fx * (static_cast<double>(d[i]) - c[i]);
    out[i] = top + fy * (bottom - top);
  }
}

}  // namespace sateen
