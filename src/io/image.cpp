// SPDX-License-Identifier: MIT
#include "sateen/io/image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>

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

ImageInfo info_of(const PictureHeader& header) {
  const PixelRect window = shown_window(header);
  ImageInfo info{window.width, window.height, header.channels, header.bits, header.floating};
  if (header.orientation >= 5) std::swap(info.width, info.height);  // turned by 90 degrees
  return info;
}

void multiply_by_alpha(std::span<float> samples, int channels) {
  const auto n = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < samples.size(); i += n) {
    for (std::size_t c = 0; c + 1 < n; ++c) samples[i + c] *= samples[i + n - 1];
  }
}

int boxes(int length, int box) {
  return (length - 1) / box + 1;
}

/// Adds a row of the picture to the row of boxes that it lies in, each pixel by its share of the box's area.
void add_row(std::span<const float> row, int y, const PixelRect& region, int box, Image& sums) {
  const int rows = std::min(box, region.height - y / box * box);
  const auto channels = static_cast<std::size_t>(sums.channels);
  for (int x = 0; x < region.width; ++x) {
    const int columns = std::min(box, region.width - x / box * box);
    const auto out = sums.pixel(x / box, y / box);
    for (std::size_t c = 0; c < channels; ++c) {
      out[c] += row[static_cast<std::size_t>(x) * channels + c] / static_cast<float>(columns * rows);
    }
  }
}

/// The stored pixels of `region`, averaged over boxes of `box` x `box`: rows above it are decoded and
/// dropped.
Image read_stored(PictureSource& source, const PixelRect& region, const SampleValues& values, int box,
                  bool multiply) {
  const PictureHeader& header = source.header();
  constexpr std::size_t kBandBytes = std::size_t{4} << 20;
  const int band = static_cast<int>(
      std::clamp<std::size_t>(kBandBytes / header.row_bytes(), 1, static_cast<std::size_t>(header.height)));
  std::vector<std::byte> rows(header.row_bytes() * static_cast<std::size_t>(band));
  Image image(boxes(region.width, box), boxes(region.height, box), header.delivered());
  const std::size_t pixel = header.row_bytes() / static_cast<std::size_t>(header.width);
  const std::size_t row_samples =
      static_cast<std::size_t>(region.width) * static_cast<std::size_t>(image.channels);
  std::vector<float> single(box > 1 ? row_samples : 0);
  // To the last row, since damage shows there; it is told wherever it lies.
  for (int first = 0; first < header.height; first += band) {
    const int count = std::min(band, header.height - first);
    source.read(count, rows.data());
    for (int y = std::max(first, region.y); y < std::min(first + count, region.y + region.height); ++y) {
      const std::byte* stored = rows.data() + header.row_bytes() * static_cast<std::size_t>(y - first) +
                                pixel * static_cast<std::size_t>(region.x);
      const std::span<float> row =
          box > 1 ? std::span(single) : std::span(image.pixel(0, y - region.y).data(), row_samples);
      values.convert(stored, static_cast<std::size_t>(region.width), row.data());
      if (multiply) multiply_by_alpha(row, image.channels);
      if (box > 1) add_row(row, y - region.y, region, box, image);
    }
  }
  return image;
}

/// The same for a picture that is in memory.
Image averaged(const Image& image, int box) {
  Image result(boxes(image.width, box), boxes(image.height, box), image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  for (int y = 0; y < image.height; ++y) {
    add_row({image.pixel(0, y).data(), row}, y, {0, 0, image.width, image.height}, box, result);
  }
  return result;
}

void check_pixels(const fs::path& path, double width, double height) {
  if (width * height <= static_cast<double>(max_pixels())) return;
  fail(path, fmt::format("has {:.0f} x {:.0f} pixels; {} are the most that are read (--max-pixels)", width,
                         height, max_pixels()));
}

std::atomic<std::int64_t>& pixel_limit() {
  static std::atomic<std::int64_t> limit{std::int64_t{1} << 28};
  return limit;
}

bool has_alpha(const PictureHeader& header) {
  const int channels = header.delivered();
  return header.alpha == channels - 1 && (channels == 2 || channels == 4);
}

/// `as_light`: colours are converted by what the file says of them.
Image decode(const fs::path& path, const ReadImageOptions& options, bool as_light) {
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
  const PixelRect window = shown_window(header);
  const bool cut =
      window.x != 0 || window.y != 0 || window.width != header.width || window.height != header.height;
  const bool whole = header.orientation > 1 || cut;
  const bool multiply = as_light && has_alpha(header) && !header.associated;
  const int box =
      options.most_across > 0 ? boxes(std::max(region.width, region.height), options.most_across) : 1;
  // Light is averaged, and what the samples need to become light is not always done row by row.
  const bool at_once = !other_colours && (integer || !srgb) && !cut && !options.region;
  check_pixels(path, at_once && box > 1 ? boxes(region.width, box) : std::max(header.width, window.width),
               at_once && box > 1 ? boxes(region.height, box) : std::max(header.height, window.height));
  Image image = read_stored(*source, whole ? stored : region, values, at_once ? box : 1, multiply && at_once);
  if (cut) image = in_window(window, std::move(image));
  if (header.orientation > 1) image = turned_upright(image, header.orientation);
  if (whole && options.region) image = cropped(image, region);
  if (!options.allow_non_finite && !integer) check_finite(path, image, region);
  if (at_once) return image;
  if (srgb && !integer) image = srgb_decoded(std::move(image));
  if (other_colours) image = to_linear_rec709(std::move(image), header, path.string());
  if (multiply) multiply_by_alpha(image.data, image.channels);
  return box > 1 ? averaged(image, box) : std::move(image);
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
  return decode(path, options, true);
}

Image read_data(const fs::path& path, bool allow_non_finite) {
  return decode(path, {.encoding = Encoding::linear, .allow_non_finite = allow_non_finite}, false);
}

void set_max_pixels(std::int64_t pixels) {
  pixel_limit() = pixels;
}

std::int64_t max_pixels() {
  return pixel_limit();
}

}  // namespace sateen::io
