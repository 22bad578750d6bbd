// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/lens_notes.h"

#include "sateen/io/exif.h"

namespace sateen::capture {

LensNotes read_lens_notes(const std::filesystem::path& path) {
  const io::ExifNotes exif = io::read_exif_of_file(path);
  LensNotes notes;
  notes.focal_mm = exif.focal_mm;
  notes.focal_35mm = exif.focal_35mm;
  notes.exposure_time = exif.exposure_time;
  return notes;
}

}  // namespace sateen::capture
