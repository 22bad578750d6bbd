// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/image_error.h"

// OpenImageIO is heavy to compile: only image.cpp and this file include it.
namespace sateen::io {
namespace {

namespace fs = std::filesystem;

void divide_by_alpha(Image& image) {
  const std::size_t n = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.data.size(); i += n) {
    const float alpha = image.data[i + n - 1];
    for (std::size_t c = 0; c + 1 < n; ++c) image.data[i + c] = alpha > 0 ? image.data[i + c] / alpha : 0;
  }
}

/// A half beyond its range would become an infinity, which no picture may hold.
void keep_in_half_range(Image& image) {
  constexpr float kMostHalf = 65504;
  for (float& v : image.data) {
    if (std::isfinite(v)) v = std::clamp(v, -kMostHalf, kMostHalf);
  }
}

/// Gives the picture to OpenImageIO, which puts the file at `path` or into `memory`; `target` is for
/// messages.
void encode(const fs::path& target, const fs::path& path, OIIO::Filesystem::IOProxy* memory,
            OIIO::ImageSpec spec, const Image& image) {
  auto output = OIIO::ImageOutput::create(path.string());
  if (!output) fail(target, "cannot be written: " + image_reason(OIIO::geterror()));
  spec["Software"] = "Sateen";
  if ((memory != nullptr && !output->set_ioproxy(memory)) || !output->open(path.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.data.data()) || !output->close()) {
    fail(target, "cannot be written: " + image_reason(output->geterror()));
  }
}

void write(const fs::path& path, const OIIO::ImageSpec& spec, const Image& image) {
  if (image.empty()) fail(path, "cannot be written: the picture has no pixels");
  const std::string extension = extension_of(path);
  if (extension == ".tif" || extension == ".tiff") {  // OpenImageIO 2.4 writes broken TIFFs into memory
    write_atomically(path, [&](const fs::path& temporary) { encode(path, temporary, nullptr, spec, image); });
    return;
  }
  // By way of memory, because libjpeg ends the process when the disk is full and other writers do not notice.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  encode(path, path, &memory, spec, image);
  write_bytes(path, std::as_bytes(std::span(bytes)));
}

}  // namespace

void write_image(const fs::path& path, const Image& image) {
  const std::string extension = extension_of(path);
  const bool floating = extension == ".exr" || extension == ".hdr";
  if (!floating && extension != ".png" && extension != ".jpg" && extension != ".jpeg" &&
      extension != ".tif" && extension != ".tiff") {
    fail(path, "unknown picture type; use .png, .jpg, .tif, .exr or .hdr");
  }
  Image out = image;
  if (extension == ".hdr") out = with_channels(out, 3);
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (jpeg) out = with_channels(out, out.channels < 3 ? 1 : 3);
  OIIO::ImageSpec spec(out.width, out.height, out.channels, OIIO::TypeDesc::UINT8);
  if (out.channels == 2) {  // OpenImageIO takes them for red and green
    spec.channelnames = {"Y", "A"};
    spec.alpha_channel = 1;
  }
  if (floating) {
    spec.format = extension == ".exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
    if (extension == ".exr") keep_in_half_range(out);
  } else {
    if (out.channels == 2 || out.channels == 4) {
      divide_by_alpha(out);
      spec["oiio:UnassociatedAlpha"] = 1;
    }
    out = srgb_encoded(std::move(out));
    for (float& v : out.data) v = std::clamp(v, 0.0f, 1.0f);
    spec["oiio:ColorSpace"] = "sRGB";
    if (jpeg) {
      spec["Compression"] = "jpeg:95";
      spec["jpeg:subsampling"] = "4:4:4";
    }
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
  keep_in_half_range(all);
  write(path, spec, all);
}

}  // namespace sateen::io
