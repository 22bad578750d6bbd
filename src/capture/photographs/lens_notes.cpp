// SPDX-License-Identifier: MIT
#include "sateen/capture/photographs/lens_notes.h"

#include <OpenImageIO/imageio.h>

namespace sateen::capture {

LensNotes read_lens_notes(const std::filesystem::path& path) {
  LensNotes notes;
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    static_cast<void>(OIIO::geterror());
    return notes;
  }
  const OIIO::ImageSpec& spec = input->spec();
  const auto positive = [&](const char* name) {
    const float value = spec.get_float_attribute(name, 0);
    return value > 0 && value < 1e5f ? static_cast<double>(value) : 0.0;
  };
  notes.focal_mm = positive("Exif:FocalLength");
  notes.focal_35mm = positive("Exif:FocalLengthIn35mmFilm");
  notes.exposure_time = positive("ExposureTime");
  return notes;
}

}  // namespace sateen::capture
