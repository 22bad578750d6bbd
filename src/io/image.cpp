// SPDX-License-Identifier: MIT
#include "sateen/io/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image_error.h"
#include "sateen/io/jpeg.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

// The most a file's compression can swell: deflate, the strongest in use, reaches 1032.
constexpr double kMaxCompression = 4096;

std::unique_ptr<OIIO::ImageInput> open(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file");
  if (fs::is_directory(path, code)) fail(path, "is a folder, a picture is needed");
  if (!fs::is_regular_file(path, code)) fail(path, "is no regular file, a picture is needed");
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path.string(), &wishes);
  if (!input) fail(path, "cannot be read as a picture: " + image_reason(OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail(path, "has no pixels");
  if (spec.depth > 1) fail(path, "is a volume, a flat picture is needed");
  if (spec.deep) fail(path, "is a deep picture, a flat one is needed");
  const double stored = static_cast<double>(fs::file_size(path, code));
  const double pixel_bytes = static_cast<double>(spec.pixel_bytes(true));
  for (const auto& [width, height] :
       {std::pair{spec.width, spec.height}, std::pair{spec.full_width, spec.full_height}}) {
    const double bytes = pixel_bytes * width * height;
    if (code || bytes > stored * kMaxCompression || bytes > 64e9) {
      fail(path,
           fmt::format("claims {} x {} pixels, more than its {} bytes can hold", width, height, stored));
    }
  }
  return input;
}

struct Decoded {
  Image image;
  int steps = 0;  ///< between 0 and 1, of integer samples; 0: float samples
  bool alpha = false;
  bool associated = false;
};

int sample_bits(const OIIO::ImageSpec& spec) {
  return spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8);
}

/// An EXR may store a part of its picture, the data window; the rest is empty, and what lies outside is cut.
Image in_display_window(const OIIO::ImageSpec& spec, Image data) {
  const int dx = spec.x - spec.full_x;
  const int dy = spec.y - spec.full_y;
  if (dx == 0 && dy == 0 && spec.full_width == spec.width && spec.full_height == spec.height) return data;
  Image full(spec.full_width, spec.full_height, data.channels);
  for (int y = std::max(0, dy); y < std::min(full.height, dy + data.height); ++y) {
    for (int x = std::max(0, dx); x < std::min(full.width, dx + data.width); ++x) {
      std::ranges::copy(data.pixel(x - dx, y - dy), full.pixel(x, y).begin());
    }
  }
  return full;
}

/// What sample k / steps stands for: itself, or the linear light of an sRGB sample. A table, since reading
/// frames is to be bound by decoding and not by powers.
std::vector<float> sample_values(int steps, bool srgb) {
  std::vector<float> values(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float sample = static_cast<float>(i) / static_cast<float>(steps);
    values[i] = srgb ? srgb_decode(sample) : sample;
  }
  return values;
}

void decode_srgb(Image& image, int steps) {
  const std::vector<float> values = sample_values(steps, true);
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::size_t colours = channels - (channels == 2 || channels == 4 ? 1 : 0);
  for (std::size_t i = 0; i < image.data.size(); i += channels) {
    for (std::size_t c = 0; c < colours; ++c) {
      float& v = image.data[i + c];
      v = values[static_cast<std::size_t>(v * static_cast<float>(steps) + 0.5f)];
    }
  }
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

Decoded decode(const fs::path& path, const ReadImageOptions& options) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.get_int_attribute("oiio:Movie") != 0 && input->seek_subimage(1, 0)) {
    fail(path, "is animated; a still picture is needed");
  }
  input->seek_subimage(0, 0);
  const std::string space(
      spec.get_string_attribute("jpeg:ColorSpace", spec.get_string_attribute("tiff:ColorSpace")));
  if (space == "CMYK" || space == "YCbCrK") fail(path, "is CMYK; convert it to RGB first");

  Decoded result;
  if (!spec.format.is_floating_point()) result.steps = spec.format.size() == 1 ? 255 : 65535;
  const int channels = std::min(spec.nchannels, 4);
  result.alpha =
      spec.alpha_channel >= 0 && spec.alpha_channel == channels - 1 && (channels == 2 || channels == 4);
  result.associated = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  const bool integer = result.steps > 0;
  const bool srgb =
      options.encoding == Encoding::srgb || (options.encoding == Encoding::automatic && integer);
  const int orientation = spec.get_int_attribute("Orientation", 1);
  const PixelRect all{0, 0, orientation >= 5 ? spec.full_height : spec.full_width,
                      orientation >= 5 ? spec.full_width : spec.full_height};
  const PixelRect region = options.region.value_or(all);
  if (!fits(region, all.width, all.height)) {
    fail(path, fmt::format("the {} x {} pixels from ({}, {}) leave the {} x {} picture", region.width,
                           region.height, region.x, region.y, all.width, all.height));
  }
  const std::string_view type = input->format_name();
  if (type == "jpeg") {
    const std::vector<float> values = sample_values(255, srgb);
    const bool upright = orientation <= 1;
    result.image =
        decode_jpeg(path, read_bytes(path), upright ? region : PixelRect{0, 0, spec.width, spec.height},
                    std::span<const float, 256>(values));
    if (!upright) result.image = cropped(turned_upright(result.image, orientation), region);
    return result;
  }
  result.image = Image(spec.width, spec.height, channels);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, result.image.data.data())) {
    fail(path, "is truncated or corrupt: " + image_reason(input->geterror()));
  }
  if (type == "openexr") result.image = in_display_window(spec, std::move(result.image));
  if (orientation > 1) result.image = turned_upright(result.image, orientation);
  if (options.region) result.image = cropped(result.image, region);
  if (!options.allow_non_finite && !integer) check_finite(path, result.image, region);
  if (srgb && integer) {
    decode_srgb(result.image, result.steps);
  } else if (srgb) {
    result.image = srgb_decoded(std::move(result.image));
  }
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
  static const std::array<std::string, 7> extensions{".png", ".jpg", ".jpeg", ".exr",
                                                     ".hdr", ".tif", ".tiff"};
  return extensions;
}

ImageInfo read_image_info(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  ImageInfo info{spec.full_width, spec.full_height, spec.nchannels, sample_bits(spec),
                 spec.format.is_floating_point()};
  if (spec.get_int_attribute("Orientation", 1) >= 5)
    std::swap(info.width, info.height);  // turned by 90 degrees
  return info;
}

Image read_image(const fs::path& path, const ReadImageOptions& options) {
  Decoded decoded = decode(path, options);
  if (decoded.alpha && !decoded.associated) multiply_by_alpha(decoded.image);
  return std::move(decoded.image);
}

Image read_data(const fs::path& path, bool allow_non_finite) {
  return decode(path, {.encoding = Encoding::linear, .allow_non_finite = allow_non_finite}).image;
}

}  // namespace sateen::io
