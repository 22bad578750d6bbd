// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "sateen/core/image.h"
#include "sateen/io/picture8.h"

namespace sateen::io {

/// The grey or RGB JPEG file `bytes` as 8-bit RGB, in the memory `picture` has already where that is enough.
/// False for what takes more than decoding: no JPEG at all, other colours (CMYK), an EXIF orientation. Throws
/// Error naming `path` when pixels are lost, anywhere in the file; padding between the picture and its end
/// marker is harmless. With `only` (not null, inside the picture) no more than that region is promised to be
/// decoded, and nothing below it is checked.
bool decode_plain_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes, Picture8& picture,
                       const PixelRect* only = nullptr);

}  // namespace sateen::io
