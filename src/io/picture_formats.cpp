// SPDX-License-Identifier: MIT
#include "sateen/io/picture_formats.h"

#include <algorithm>
#include <array>

#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/picture_process.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using Start = std::string_view;

constexpr Start kPng[] = {".png"};
constexpr Start kJpeg[] = {".jpg", ".jpeg"};
constexpr Start kExr[] = {".exr"};
constexpr Start kHdr[] = {".hdr"};
constexpr Start kTiff[] = {".tif", ".tiff"};
constexpr Start kWebp[] = {".webp"};

bool starts_as_tiff(Start bytes) {
  return bytes.starts_with(Start("II*\0", 4)) || bytes.starts_with(Start("MM\0*", 4)) ||
         bytes.starts_with(Start("II+\0", 4)) || bytes.starts_with(Start("MM\0+", 4));
}

constexpr PictureFormat kPictureFormats[] = {
    {.name = "PNG",
     .extensions = kPng,
     .starts_so = [](Start bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); },
     .open = open_png,
     .create = create_png},
    {.name = "JPEG",
     .extensions = kJpeg,
     .starts_so = [](Start bytes) { return bytes.starts_with("\xff\xd8\xff"); },
     .open = open_jpeg,
     .create = create_jpeg,
     .alpha = false},
    {.name = "OpenEXR",
     .extensions = kExr,
     .starts_so = [](Start bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); },
     .open = open_exr,
     .create = create_exr,
     .linear = true},
    {.name = "Radiance HDR",
     .extensions = kHdr,
     .starts_so = [](Start bytes) { return bytes.starts_with("#?"); },
     .open = open_hdr,
     .create = create_hdr,
     .linear = true,
     .alpha = false,
     .grey = false},
    {.name = "TIFF",
     .extensions = kTiff,
     .starts_so = starts_as_tiff,
     .open = open_tiff,
     .create = create_tiff},
    {.name = "WebP",
     .extensions = kWebp,
     .starts_so =
         [](Start bytes) { return bytes.starts_with("RIFF") && bytes.substr(8).starts_with("WEBP"); },
     .open = open_webp,
     .create = create_webp},
};

std::string first_bytes(const PictureBytes& bytes) {
  std::string first(16, '\0');
  first.resize(std::fread(first.data(), 1, first.size(), bytes.stream.get()));
  std::rewind(bytes.stream.get());
  return first;
}

SourcePtr open_known(const fs::path& path) {
  PictureBytes bytes = open_picture_file(path);
  const std::string first = first_bytes(bytes);
  const auto* format =
      std::ranges::find_if(kPictureFormats, [&](const PictureFormat& f) { return f.starts_so(first); });
  if (format == std::end(kPictureFormats)) return nullptr;
  // Raw files of cameras are TIFFs by their structure.
  if (format->open == open_tiff && format_of_extension(extension_of(path)) == nullptr) return nullptr;
  return format->open(std::move(bytes));
}

}  // namespace

std::span<const PictureFormat> picture_formats() {
  return kPictureFormats;
}

const PictureFormat* format_of_extension(std::string_view extension) {
  const auto* format = std::ranges::find_if(kPictureFormats, [&](const PictureFormat& f) {
    return std::ranges::find(f.extensions, extension) != f.extensions.end();
  });
  return format == std::end(kPictureFormats) ? nullptr : format;
}

SourcePtr open_picture(const fs::path& path) {
  SourcePtr source = open_known(path);
  if (!source) source = open_with_openimageio(path);
  std::error_code code;
  check_size(path.string(), source->header(), fs::file_size(path, code));
  return source;
}

void check_size(const std::string& name, const PictureHeader& header, std::uintmax_t stored) {
  if (header.width < 1 || header.height < 1 || header.channels < 1) fail(name, "has no pixels");
  const double pixel = header.channels * header.bits / 8.0;
  for (const auto& [width, height] :
       {std::pair{header.width, header.height}, std::pair{header.window.width, header.window.height}}) {
    const double bytes = pixel * width * height;
    if (bytes > static_cast<double>(stored) * header.swelling || bytes > 64e9)
      fail(name,
           fmt::format("claims {} x {} pixels, more than its {} bytes can hold", width, height, stored));
  }
}

}  // namespace sateen::io
