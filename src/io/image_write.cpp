// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include <fmt/format.h>

#include "sateen/core/colour.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/image.h"
#include "sateen/io/image_encode.h"
#include "sateen/io/picture_formats.h"

namespace sateen::io {

namespace fs = std::filesystem;

std::vector<std::string> channel_names(int count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default:
      break;
  }
  std::vector<std::string> names{"R", "G", "B", "A"};
  for (int c = 4; c < count; ++c) names.push_back(fmt::format("channel{}", c));
  return names;
}

namespace {

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

PictureLayout layout_of(const Image& image, RowSamples samples) {
  return {.width = image.width,
          .height = image.height,
          .channels = channel_names(image.channels),
          .samples = samples};
}

void write_samples(const PictureFormat& format, std::FILE* stream, const std::string& name,
                   const PictureLayout& layout, const Image& image) {
  const SinkPtr sink = format.create(stream, name, layout);
  sink->write(image.height, image.data.data());
  sink->finish();
}

/// Into a file called `temporary` that messages call `path`.
void put_picture(const fs::path& temporary, const fs::path& path, const PictureFormat& format,
                 const PictureLayout& layout, const Image& image) {
  if (image.empty()) fail(path, "cannot be written: the picture has no pixels");
  FileStream file = create_file(temporary, path.string());
  write_samples(format, file.get(), path.string(), layout, image);
  close_written(std::move(file), path.string());
}

void write(const fs::path& path, const PictureFormat& format, const PictureLayout& layout,
           const Image& image) {
  write_atomically(path,
                   [&](const fs::path& temporary) { put_picture(temporary, path, format, layout, image); });
}

/// The samples that a file of this format holds of a picture, and how.
struct Prepared {
  Image image;
  PictureLayout layout;
};

Prepared prepared(const PictureFormat& format, const Image& linear) {
  Image out = linear;
  if (!format.grey) out = with_channels(out, 3);
  if (!format.alpha) out = with_channels(out, out.channels < 3 ? 1 : 3);
  if (!format.linear) {
    if (out.channels == 2 || out.channels == 4) divide_by_alpha(out);
    out = srgb_encoded(std::move(out));
  }
  if (format.linear && format.alpha) keep_in_half_range(out);
  PictureLayout layout = layout_of(out, format.linear ? RowSamples::f16 : RowSamples::u8);
  layout.srgb = !format.linear;
  return {std::move(out), std::move(layout)};
}

std::string writable_extensions() {
  std::string list;
  for (const PictureFormat& format : picture_formats()) {
    const bool last = &format == &picture_formats().back();
    list += (list.empty() ? "" : last ? " or " : ", ") + std::string(format.extensions.front());
  }
  return list;
}

const PictureFormat& format_to_write(const fs::path& path) {
  const PictureFormat* format = format_of_extension(extension_of(path));
  if (format == nullptr) fail(path, "unknown picture type; use " + writable_extensions());
  return *format;
}

/// A stream that collects what is written to it.
struct MemoryStream {
  char* bytes = nullptr;
  std::size_t count = 0;
  FileStream stream{open_memstream(&bytes, &count)};
  ~MemoryStream() {
    stream.reset();
    std::free(bytes);
  }
};

std::vector<std::byte> encoded(const PictureFormat& format, const PictureLayout& layout,
                               const Image& samples) {
  if (samples.empty()) throw Error("a picture without pixels cannot be encoded");
  MemoryStream memory;
  write_samples(format, memory.stream.get(), "the picture", layout, samples);
  memory.stream.reset();
  const auto bytes = std::as_bytes(std::span(memory.bytes, memory.count));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

void write_image(const fs::path& path, const Image& image) {
  const PictureFormat& format = format_to_write(path);
  const Prepared out = prepared(format, image);
  write(path, format, out.layout, out.image);
}

void check_image_writable(const fs::path& path) {
  format_to_write(path);
  check_writable(std::span(&path, 1));
}

void write_data(const fs::path& path, const Image& image) {
  write_data(std::span(&path, 1), std::span(&image, 1));
}

void write_data(std::span<const fs::path> paths, std::span<const Image> images) {
  for (const fs::path& path : paths) {
    const std::string extension = extension_of(path);
    if (extension != ".png" && extension != ".exr") fail(path, "data pictures are written as .exr or .png");
  }
  write_atomically(paths, [&](std::span<const fs::path> temporaries) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto samples = extension_of(paths[i]) == ".png" ? RowSamples::u16 : RowSamples::f32;
      put_picture(temporaries[i], paths[i], format_to_write(paths[i]), layout_of(images[i], samples),
                  images[i]);
    }
  });
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
  PictureLayout layout = layout_of(all, RowSamples::f16);
  layout.channels.clear();
  int first = 0;
  for (const ImageLayer& layer : layers) {
    for (int c = 0; c < layer.image.channels; ++c) {
      layout.channels.push_back(fmt::format("{}.{}", layer.name, "RGBA"[c]));
    }
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        std::ranges::copy(layer.image.pixel(x, y), all.pixel(x, y).begin() + first);
      }
    }
    first += layer.image.channels;
  }
  keep_in_half_range(all);
  write(path, format_to_write(path), layout, all);
}

std::vector<std::byte> encode_png(const Image& image) {
  const PictureFormat& format = *format_of_extension(".png");
  const Prepared out = prepared(format, image);
  return encoded(format, out.layout, out.image);
}

std::vector<std::byte> encode_jpeg(const Image& image, int quality) {
  const PictureFormat& format = *format_of_extension(".jpg");
  Prepared out = prepared(format, image);
  out.layout.quality = quality;
  return encoded(format, out.layout, out.image);
}

std::vector<std::byte> encode_png(const Picture8& picture) {
  Image samples(picture.width, picture.height, 3);
  std::ranges::transform(picture.rgb, samples.data.begin(),
                         [](std::uint8_t v) { return static_cast<float>(v) / 255; });
  PictureLayout layout = layout_of(samples, RowSamples::u8);
  layout.quick = true;
  return encoded(*format_of_extension(".png"), layout, samples);
}

}  // namespace sateen::io
