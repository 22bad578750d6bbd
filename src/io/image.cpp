// SPDX-License-Identifier: MIT
#include "sateen/io/image.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/colour_conversion.h"
#include "sateen/io/file_error.h"
#include "sateen/io/picture_formats.h"
#include "sateen/io/sample_values.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

/// An EXR may store a part of its picture, the data window; the rest is empty, and what lies outside is cut.
Image in_window(const PixelRect& window, Image data) {
  if (window.x == 0 && window.y == 0 && window.width == data.width && window.height == data.height)
    return data;
  Image full(window.width, window.height, data.channels);
  for (int y = std::max(0, -window.y); y < std::min(full.height, data.height - window.y); ++y) {
    for (int x = std::max(0, -window.x); x < std::min(full.width, data.width - window.x); ++x) {
      std::ranges::copy(data.pixel(x + window.x, y + window.y), full.pixel(x, y).begin());
    }
  }
  return full;
}

Image turned_upright(const Image& image, int orientation) {
  // Not OpenImageIO's reorient(), which takes 5 and 7 for each other (its issue 4661).
  const bool transposed = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image result(transposed ? image.height : image.width, transposed ? image.width : image.height,
               image.channels);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const int u = transposed ? y : x;
      const int v = transposed ? x : y;
      std::ranges::copy(
          image.pixel(from_right ? image.width - 1 - u : u, from_below ? image.height - 1 - v : v),
          result.pixel(x, y).begin());
    }
  }
  return result;
}

void check_finite(const fs::path& path, const Image& image, const PixelRect& region) {
  const auto bad = std::ranges::find_if_not(image.data, [](float v) { return std::isfinite(v); });
  if (bad == image.data.end()) return;
  const auto pixel = (bad - image.data.begin()) / image.channels;
  fail(path, fmt::format("has a value that is not finite at pixel ({}, {})", region.x + pixel % image.width,
                         region.y + pixel / image.width));
}

PixelRect window_of(const PictureHeader& header) {
  return header.window.width > 0 ? header.window : PixelRect{0, 0, header.width, header.height};
}

ImageInfo info_of(const PictureHeader& header) {
  const PixelRect window = window_of(header);
  ImageInfo info{window.width, window.height, header.channels, header.bits, header.floating};
  if (header.orientation >= 5) std::swap(info.width, info.height);  // turned by 90 degrees
  return info;
}

/// The stored pixels of `region`: rows above it are decoded and dropped, rows below are not.
Image read_stored(PictureSource& source, const PixelRect& region, const SampleValues& values) {
  const PictureHeader& header = source.header();
  constexpr std::size_t kBandBytes = std::size_t{4} << 20;
  const int band = static_cast<int>(
      std::clamp<std::size_t>(kBandBytes / header.row_bytes(), 1, static_cast<std::size_t>(header.height)));
  std::vector<std::byte> rows(header.row_bytes() * static_cast<std::size_t>(band));
  Image image(region.width, region.height, header.delivered());
  const std::size_t pixel = header.row_bytes() / static_cast<std::size_t>(header.width);
  // To the last row, since damage shows there; it is told wherever it lies.
  for (int first = 0; first < header.height; first += band) {
    const int count = std::min(band, header.height - first);
    source.read(count, rows.data());
    for (int y = std::max(first, region.y); y < std::min(first + count, region.y + region.height); ++y) {
      const std::byte* row = rows.data() + header.row_bytes() * static_cast<std::size_t>(y - first) +
                             pixel * static_cast<std::size_t>(region.x);
      values.convert(row, static_cast<std::size_t>(region.width), image.pixel(0, y - region.y).data());
    }
  }
  return image;
}

struct Decoded {
  Image image;
  bool multiply = false;  ///< alpha has not been multiplied in yet
};

bool has_alpha(const PictureHeader& header) {
  const int channels = header.delivered();
  return header.alpha == channels - 1 && (channels == 2 || channels == 4);
}

/// `as_light`: colours are converted by what the file says of them.
Decoded decode(const fs::path& path, const ReadImageOptions& options, bool as_light) {
  const auto source = open_picture(path);
  const PictureHeader& header = source->header();
  const ImageInfo info = info_of(header);
  const PixelRect region = options.region.value_or(PixelRect{0, 0, info.width, info.height});
  if (!fits(region, info.width, info.height)) {
    fail(path, fmt::format("the {} x {} pixels from ({}, {}) leave the {} x {} picture", region.width,
                           region.height, region.x, region.y, info.width, info.height));
  }
  const bool integer = !header.floating;
  const bool other_colours =
      as_light && options.encoding == Encoding::automatic && says_other_colours(header);
  const bool srgb = options.encoding == Encoding::srgb ||
                    (options.encoding == Encoding::automatic && integer && !other_colours);
  const SampleValues values(header, srgb);
  const PixelRect stored{0, 0, header.width, header.height};
  const PixelRect window = window_of(header);
  const bool whole = header.orientation > 1 || window.x != 0 || window.y != 0 ||
                     window.width != header.width || window.height != header.height;
  Decoded result{read_stored(*source, whole ? stored : region, values),
                 has_alpha(header) && !header.associated};
  if (whole) {
    result.image = in_window(window, std::move(result.image));
    if (header.orientation > 1) result.image = turned_upright(result.image, header.orientation);
    if (options.region) result.image = cropped(result.image, region);
  }
  if (!options.allow_non_finite && !integer) check_finite(path, result.image, region);
  if (srgb && !integer) result.image = srgb_decoded(std::move(result.image));
  if (other_colours) result.image = to_linear_rec709(std::move(result.image), header, path.string());
  return result;
}

void multiply_by_alpha(Image& image) {
  const std::size_t n = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.data.size(); i += n) {
    for (std::size_t c = 0; c + 1 < n; ++c) image.data[i + c] *= image.data[i + n - 1];
  }
}

}  // namespace

std::span<const std::string> image_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> all;
    for (const PictureFormat& format : picture_formats())
      all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    return all;
  }();
  return extensions;
}

ImageInfo read_image_info(const fs::path& path) {
  return info_of(open_picture(path)->header());
}

Image read_image(const fs::path& path, const ReadImageOptions& options) {
  Decoded decoded = decode(path, options, true);
  if (decoded.multiply) multiply_by_alpha(decoded.image);
  return std::move(decoded.image);
}

Image read_data(const fs::path& path, bool allow_non_finite) {
  return decode(path, {.encoding = Encoding::linear, .allow_non_finite = allow_non_finite}, false).image;
}

}  // namespace sateen::io
