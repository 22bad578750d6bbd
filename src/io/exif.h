// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace sateen::io {

/// What a camera notes beside its pixels. 0 where it did not say.
struct ExifNotes {
  int orientation = 1;       ///< how the picture is to be turned: 1 upright, to 8
  double focal_mm = 0;       ///< focal length
  double focal_35mm = 0;     ///< the same for the sensor of a 35 mm camera
  double exposure_time = 0;  ///< s
};

/// Reads an EXIF block, from its TIFF header ("II" or "MM") on. Broken blocks say as much as can be read.
ExifNotes read_exif(std::span<const std::byte> block);

/// The EXIF block of a JPEG, PNG, WebP or TIFF file; nothing noted when there is none or no such file.
ExifNotes read_exif_of_file(const std::filesystem::path& path);

}  // namespace sateen::io
