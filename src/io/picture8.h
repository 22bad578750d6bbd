// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sateen/core/image.h"

namespace sateen::io {

/// A decoded 8-bit picture as its file or the camera encodes it (usually sRGB), for work that cannot wait for
/// floats. Interleaved RGB, row 0 on top: channel c of pixel (x, y) is rgb[(y * width + x) * 3 + c].
struct Picture8 {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Reads a PNG, JPEG or TIFF of 8 bits a sample, turned upright by its EXIF orientation; grey is repeated,
/// alpha is dropped. Throws Error naming the file when it is missing, truncated, or no picture.
Picture8 read_picture8(const std::filesystem::path& path);

/// The same into memory that is there: reading pictures of one size into the same `picture` again and again
/// saves the system fetching and clearing its pages each time.
void read_picture8(const std::filesystem::path& path, Picture8& picture);

/// The same where only `region` (inside the picture) will be looked at: what lies beside it may be anything,
/// and damage below it may go unnoticed. Of a plain JPEG little else is decoded.
void read_picture8(const std::filesystem::path& path, const PixelRect& region, Picture8& picture);

}  // namespace sateen::io
