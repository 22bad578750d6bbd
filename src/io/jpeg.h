// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "sateen/core/image.h"

namespace sateen {

/// Decodes the grey or RGB JPEG file `bytes` into samples k / 255, nothing converted or turned. libjpeg fills
/// what is missing or broken with grey and only warns, and OpenImageIO passes few of its warnings on; here
/// each one that means lost pixels is an Error naming `path`. Padding between the picture and its end marker
/// is harmless.
Image decode_jpeg(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace sateen
