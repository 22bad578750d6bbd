// SPDX-License-Identifier: MIT
#include "sateen/io/image_memory.h"

#include <string_view>

#include "sateen/io/file_error.h"
#include "sateen/io/picture_formats.h"
#include "sateen/io/sample_values.h"

namespace sateen::io {

Image read_data_from_memory(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view first(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const PictureFormat* format = nullptr;
  for (const char* extension : {".png", ".jpg", ".webp"}) {
    const PictureFormat* candidate = format_of_extension(extension);
    if (candidate->starts_so(first)) format = candidate;
  }
  if (format == nullptr) fail(name, "is neither PNG nor JPEG nor WebP");
  const SourcePtr source = format->open(open_picture_memory(bytes, name));
  const PictureHeader& header = source->header();
  check_size(name, header, bytes.size());
  std::vector<std::byte> samples(header.row_bytes() * static_cast<std::size_t>(header.height));
  source->read(header.height, samples.data());
  Image image(header.width, header.height, header.delivered());
  SampleValues(header, false)
      .convert(samples.data(),
               static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height),
               image.data.data());
  return image;
}

}  // namespace sateen::io
