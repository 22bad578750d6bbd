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

namespace sateen {
namespace {

namespace fs = std::filesystem;

// The most a file's compression can swell: deflate, the strongest in use, reaches 1032.
constexpr double kMaxCompression = 4096;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

std::string reason(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  return message.empty() ? "unknown reason" : message;
}

std::unique_ptr<OIIO::ImageInput> open(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file");
  if (fs::is_directory(path, code)) fail(path, "is a folder, a picture is needed");
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  auto input = OIIO::ImageInput::open(path.string(), &wishes);
  if (!input) fail(path, "cannot be read as a picture: " + reason(OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail(path, "has no pixels");
  if (spec.depth > 1) fail(path, "is a volume, a flat picture is needed");
  if (spec.deep) fail(path, "is a deep picture, a flat one is needed");
  const double bytes = static_cast<double>(spec.image_bytes(true));
  const double stored = static_cast<double>(fs::file_size(path));
  if (bytes > stored * kMaxCompression || bytes > 64e9) {
    fail(path, fmt::format("claims {} x {} pixels, more than its {} bytes can hold", spec.width, spec.height,
                           stored));
  }
  return input;
}

struct Decoded {
  Image image;
  bool floating = false;
  bool alpha = false;
  bool associated = false;
};

int sample_bits(const OIIO::ImageSpec& spec) {
  return spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8);
}

Decoded decode(const fs::path& path, bool allow_non_finite) {
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
  result.floating = spec.format.is_floating_point();
  const int channels = std::min(spec.nchannels, 4);
  result.alpha =
      spec.alpha_channel >= 0 && spec.alpha_channel == channels - 1 && (channels == 2 || channels == 4);
  result.associated = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  result.image = Image(spec.width, spec.height, channels);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, result.image.data.data())) {
    fail(path, "is truncated or corrupt: " + reason(input->geterror()));
  }
  if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation > 1) {
    OIIO::ImageSpec flat(result.image.width, result.image.height, channels, OIIO::TypeDesc::FLOAT);
    flat["Orientation"] = orientation;
    const OIIO::ImageBuf turned =
        OIIO::ImageBufAlgo::reorient(OIIO::ImageBuf(flat, result.image.data.data()));
    result.image = Image(turned.spec().width, turned.spec().height, channels);
    turned.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, result.image.data.data());
  }
  if (!allow_non_finite && result.floating) {
    const auto bad = std::ranges::find_if_not(result.image.data, [](float v) { return std::isfinite(v); });
    if (bad != result.image.data.end()) {
      const auto pixel = (bad - result.image.data.begin()) / channels;
      fail(path, fmt::format("has a value that is not finite at pixel ({}, {})", pixel % result.image.width,
                             pixel / result.image.width));
    }
  }
  return result;
}

void multiply_by_alpha(Image& image, bool divide) {
  const std::size_t n = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.data.size(); i += n) {
    const float alpha = image.data[i + n - 1];
    const float factor = divide ? (alpha > 0 ? 1 / alpha : 0) : alpha;
    for (std::size_t c = 0; c + 1 < n; ++c) image.data[i + c] *= factor;
  }
}

void write(const fs::path& path, OIIO::ImageSpec spec, const Image& image) {
  write_atomically(path, [&](const fs::path& temporary) {
    auto output = OIIO::ImageOutput::create(temporary.string());
    if (!output) fail(path, "cannot be written: " + reason(OIIO::geterror()));
    spec["Software"] = "Sateen";
    if (!output->open(temporary.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, image.data.data()) || !output->close()) {
      fail(path, "cannot be written: " + reason(output->geterror()));
    }
  });
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
  return {spec.width, spec.height, spec.nchannels, sample_bits(spec), spec.format.is_floating_point()};
}

Image read_image(const fs::path& path, const ReadImageOptions& options) {
  Decoded decoded = decode(path, options.allow_non_finite);
  const bool srgb =
      options.encoding == Encoding::srgb || (options.encoding == Encoding::automatic && !decoded.floating);
  if (srgb) decoded.image = srgb_decoded(std::move(decoded.image));
  if (decoded.alpha && !decoded.associated) multiply_by_alpha(decoded.image, false);
  return std::move(decoded.image);
}

Image read_data(const fs::path& path, bool allow_non_finite) {
  return decode(path, allow_non_finite).image;
}

void write_image(const fs::path& path, const Image& image) {
  const std::string extension = extension_of(path);
  const bool floating = extension == ".exr" || extension == ".hdr";
  if (!floating && extension != ".png" && extension != ".jpg" && extension != ".jpeg" &&
      extension != ".tif" && extension != ".tiff") {
    fail(path, "unknown picture type; use .png, .jpg, .tif, .exr or .hdr");
  }
  const bool no_alpha = extension == ".jpg" || extension == ".jpeg" || extension == ".hdr";
  Image out = no_alpha && image.channels > 3 ? with_channels(image, 3) : image;
  OIIO::ImageSpec spec(out.width, out.height, out.channels, OIIO::TypeDesc::UINT8);
  if (floating) {
    spec.format = extension == ".exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
  } else {
    if (out.channels == 2 || out.channels == 4) {
      multiply_by_alpha(out, true);
      spec["oiio:UnassociatedAlpha"] = 1;
    }
    out = srgb_encoded(std::move(out));
    for (float& v : out.data) v = std::clamp(v, 0.0f, 1.0f);
    spec["oiio:ColorSpace"] = "sRGB";
    if (no_alpha) spec["Compression"] = "jpeg:95";
  }
  write(path, spec, out);
}

void write_data(const fs::path& path, const Image& image) {
  const std::string extension = extension_of(path);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (extension == ".png") {
    spec.format = OIIO::TypeDesc::UINT16;
  } else if (extension != ".exr") {
    fail(path, "data pictures are written as .exr or .png");
  }
  spec["oiio:ColorSpace"] = "Linear";
  spec["oiio:UnassociatedAlpha"] = 1;
  write(path, spec, image);
}

void write_layers(const fs::path& path, std::span<const ImageLayer> layers) {
  if (extension_of(path) != ".exr") fail(path, "layers are written as .exr");
  if (layers.empty()) fail(path, "there are no layers to write");
  int channels = 0;
  for (const ImageLayer& layer : layers) {
    if (layer.image.width != layers[0].image.width || layer.image.height != layers[0].image.height) {
      fail(path, fmt::format("layer {} differs in size from layer {}", layer.name, layers[0].name));
    }
    channels += layer.image.channels;
  }
  Image all(layers[0].image.width, layers[0].image.height, channels);
  OIIO::ImageSpec spec(all.width, all.height, channels, OIIO::TypeDesc::HALF);
  spec.channelnames.clear();
  int first = 0;
  for (const ImageLayer& layer : layers) {
    for (int c = 0; c < layer.image.channels; ++c) {
      spec.channelnames.push_back(fmt::format("{}.{}", layer.name, "RGBA"[c]));
    }
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        std::ranges::copy(layer.image.pixel(x, y), all.pixel(x, y).begin() + first);
      }
    }
    first += layer.image.channels;
  }
  spec.alpha_channel = -1;
  write(path, spec, all);
}

}  // namespace sateen
