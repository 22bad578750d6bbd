// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sateen::capture {

/// What the camera's own notes say of the lens, from EXIF; zeros where it does not say. Never throws for
/// unreadable EXIF: that is as good as none.
struct LensNotes {
  double focal_mm = 0;
  double focal_35mm = 0;     ///< equivalent on a 36 mm wide sensor
  double exposure_time = 0;  ///< seconds
};
LensNotes read_lens_notes(const std::filesystem::path& path);

}  // namespace sateen::capture
