// SPDX-License-Identifier: MIT
#include "sateen/io/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image_error.h"
#include "sateen/io/jpeg.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

// The most a file's compression can swell: deflate, the strongest in use, reaches 1032.
constexpr double kMaxCompression = 4096;

std::unique_ptr<OIIO::ImageInput> open(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) image_fail(path, "no such file");
  if (fs::is_directory(path, code)) image_fail(path, "is a folder, a picture is needed");
  if (!fs::is_regular_file(path, code)) image_fail(path, "is no regular file, a picture is needed");
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path.string(), &wishes);
  if (!input) image_fail(path, "cannot be read as a picture: " + image_reason(OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) image_fail(path, "has no pixels");
  if (spec.depth > 1) image_fail(path, "is a volume, a flat picture is needed");
  if (spec.deep) image_fail(path, "is a deep picture, a flat one is needed");
  const double stored = static_cast<double>(fs::file_size(path, code));
  const double pixel_bytes = static_cast<double>(spec.pixel_bytes(true));
  for (const auto& [width, height] :
       {std::pair{spec.width, spec.height}, std::pair{spec.full_width, spec.full_height}}) {
    const double bytes = pixel_bytes * width * height;
    if (code || bytes > stored * kMaxCompression || bytes > 64e9) {
      image_fail(
          path, fmt::format("claims {} x {} pixels, more than its {} bytes can hold", width, height, stored));
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

Decoded decode(const fs::path& path, bool allow_non_finite) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.get_int_attribute("oiio:Movie") != 0 && input->seek_subimage(1, 0)) {
    image_fail(path, "is animated; a still picture is needed");
  }
  input->seek_subimage(0, 0);
  const std::string space(
      spec.get_string_attribute("jpeg:ColorSpace", spec.get_string_attribute("tiff:ColorSpace")));
  if (space == "CMYK" || space == "YCbCrK") image_fail(path, "is CMYK; convert it to RGB first");

  Decoded result;
  if (!spec.format.is_floating_point()) result.steps = spec.format.size() == 1 ? 255 : 65535;
  const int channels = std::min(spec.nchannels, 4);
  result.alpha =
      spec.alpha_channel >= 0 && spec.alpha_channel == channels - 1 && (channels == 2 || channels == 4);
  result.associated = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  const std::string_view type = input->format_name();
  if (type == "jpeg") {
    result.image = decode_jpeg(path, read_bytes(path));
  } else {
    result.image = Image(spec.width, spec.height, channels);
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, result.image.data.data())) {
      image_fail(path, "is truncated or corrupt: " + image_reason(input->geterror()));
    }
  }
  if (type == "openexr") result.image = in_display_window(spec, std::move(result.image));
  if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation > 1) {
    OIIO::ImageSpec flat(result.image.width, result.image.height, channels, OIIO::TypeDesc::FLOAT);
    flat["Orientation"] = orientation;
    const OIIO::ImageBuf turned =
        OIIO::ImageBufAlgo::reorient(OIIO::ImageBuf(flat, result.image.data.data()));
    result.image = Image(turned.spec().width, turned.spec().height, channels);
    turned.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, result.image.data.data());
  }
  if (!allow_non_finite && result.steps == 0) {
    const auto bad = std::ranges::find_if_not(result.image.data, [](float v) { return std::isfinite(v); });
    if (bad != result.image.data.end()) {
      const auto pixel = (bad - result.image.data.begin()) / channels;
      image_fail(path, fmt::format("has a value that is not finite at pixel ({}, {})",
                                   pixel % result.image.width, pixel / result.image.width));
    }
  }
  return result;
}

/// srgb_decoded for samples k / steps, by a table: reading frames is bound by decoding, not by powers.
void decode_srgb(Image& image, int steps) {
  std::vector<float> table(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = srgb_decode(static_cast<float>(i) / static_cast<float>(steps));
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::size_t colours = channels - (channels == 2 || channels == 4 ? 1 : 0);
  for (std::size_t i = 0; i < image.data.size(); i += channels) {
    for (std::size_t c = 0; c < colours; ++c) {
      float& v = image.data[i + c];
      v = table[static_cast<std::size_t>(v * static_cast<float>(steps) + 0.5f)];
    }
  }
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
  Decoded decoded = decode(path, options.allow_non_finite);
  const bool srgb =
      options.encoding == Encoding::srgb || (options.encoding == Encoding::automatic && decoded.steps > 0);
  if (srgb && decoded.steps > 0) {
    decode_srgb(decoded.image, decoded.steps);
  } else if (srgb) {
    decoded.image = srgb_decoded(std::move(decoded.image));
  }
  if (decoded.alpha && !decoded.associated) multiply_by_alpha(decoded.image);
  return std::move(decoded.image);
}

Image read_data(const fs::path& path, bool allow_non_finite) {
  return decode(path, allow_non_finite).image;
}

}  // namespace sateen
