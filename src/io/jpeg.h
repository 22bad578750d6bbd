// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "sateen/core/image.h"
#include "sateen/io/picture8.h"

namespace sateen::io {

/// Decodes the rows of `region` of the grey or RGB JPEG file `bytes`, sample k becoming values[k]; nothing is
/// turned. libjpeg fills what is missing or broken with grey and only warns, and OpenImageIO passes few of
/// its warnings on; here each one that means lost pixels, anywhere in the file, is an Error naming `path`.
/// Padding between the picture and its end marker is harmless.
Image decode_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes,
                  const PixelRect& region, std::span<const float, 256> values);

/// The grey or RGB JPEG file `bytes` as 8-bit RGB, in the memory `picture` has already where that is enough.
/// False for what takes more than decoding: no JPEG at all, other colours (CMYK), an EXIF orientation. Throws
/// as decode_jpeg does. With `only` (not null, inside the picture) no more than that region is promised to be
/// decoded, and nothing below it is checked.
bool decode_plain_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes, Picture8& picture,
                       const PixelRect* only = nullptr);

}  // namespace sateen::io
