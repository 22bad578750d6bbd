// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sateen/io/picture_codecs.h"

namespace sateen::io {

/// A picture format that the library itself reads and writes; one line of the table below each.
struct PictureFormat {
  std::string_view name;                         ///< as in messages
  std::span<const std::string_view> extensions;  ///< lower case with the dot
  /// Whether a file that starts so is one; 16 bytes or the whole file.
  bool (*starts_so)(std::string_view first_bytes);
  /// Null, and null from it where OpenImageIO has to help.
  SourcePtr (*open)(PictureBytes bytes);
  SinkPtr (*create)(std::FILE* stream, const std::string& name, const PictureLayout& layout);
  bool linear = false;  ///< written as light; otherwise as sRGB in 8 bits, clamped
  bool alpha = true;    ///< whether it can have alpha
  bool grey = true;     ///< whether it can have one channel
};

std::span<const PictureFormat> picture_formats();

/// The format of an extension with its dot; null when there is none.
const PictureFormat* format_of_extension(std::string_view extension);

/// Opens a picture of any format by its first bytes: of what is in the table, else through OpenImageIO.
/// Throws Error when the file is missing, no picture, or larger than its bytes can hold.
SourcePtr open_picture(const std::filesystem::path& path);

}  // namespace sateen::io
