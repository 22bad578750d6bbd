// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "sateen/core/image.h"

namespace sateen::io {

/// read_data() for a PNG, JPEG or WebP that lies in memory, as inside a GLB: samples as stored, 8 and 16 bit
/// scaled to [0, 1], not turned by EXIF. `name` is what error messages call it. Throws Error when the bytes
/// are no such picture or are truncated.
Image read_data_from_memory(std::span<const std::byte> bytes, const std::string& name);

}  // namespace sateen::io
