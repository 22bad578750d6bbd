// SPDX-License-Identifier: MIT
#include "sateen/io/picture8.h"

#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/io/jpeg.h"
#include "sateen/io/picture_sink.h"

namespace sateen::io {

Picture8 read_picture8(const std::filesystem::path& path) {
  Picture8 picture;
  read_picture8(path, picture);
  return picture;
}

namespace {

void read_picture8(const std::filesystem::path& path, const PixelRect* only, Picture8& picture) {
  const std::string extension = extension_of(path);
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (jpeg && decode_plain_jpeg(path, read_bytes(path), picture, only)) return;
  const Image image = with_channels(read_data(path), 3);
  picture.width = image.width;
  picture.height = image.height;
  picture.rgb.clear();
  picture.rgb.reserve(image.data.size());
  for (const float v : image.data) picture.rgb.push_back(static_cast<std::uint8_t>(quantised(v, 255)));
}

}  // namespace

void read_picture8(const std::filesystem::path& path, Picture8& picture) {
  read_picture8(path, nullptr, picture);
}

void read_picture8(const std::filesystem::path& path, const PixelRect& region, Picture8& picture) {
  read_picture8(path, &region, picture);
}

}  // namespace sateen::io
