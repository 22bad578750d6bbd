// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/io/picture8.h"

namespace sateen::io {

/// The bytes of the file write_image() would write, for reports that hold their pictures. Throws Error for a
/// picture without pixels.
std::vector<std::byte> encode_png(const Image& image);
/// `quality` from 1 to 100.
std::vector<std::byte> encode_jpeg(const Image& image, int quality = 95);

/// A picture as it is, encoded sooner and larger: for frames as they are taken.
std::vector<std::byte> encode_png(const Picture8& picture);

}  // namespace sateen::io
