// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/choose_camera.h"

#include <cmath>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::capture {

Camera choose_camera(const FrameSource& source, const CaptureOptions& options) {
  const int width = source.width();
  const int height = source.height();
  if (options.camera) {
    const double factor = static_cast<double>(width) / options.camera->width;
    if (std::abs(options.camera->height * factor - height) > 1.5) {
      throw Error(fmt::format("the calibration is for pictures of {} x {}, these are {} x {}: another shape",
                              options.camera->width, options.camera->height, width, height));
    }
    Camera camera = options.camera->scaled(factor);
    camera.width = width;
    camera.height = height;
    return camera;
  }
  const auto pinhole = [&](double focal, const char* from) {
    Camera camera = Camera::pinhole(width, height, focal);
    camera.focal_source = from;
    return camera;
  };
  if (options.fov > 0) return pinhole(focal_of_fov(width, options.fov), "field of view given");
  const LensNotes notes = source.is_video() ? LensNotes{} : read_lens_notes(source.path(0));
  const double focal_mm = options.focal_mm > 0 ? options.focal_mm : notes.focal_mm;
  if (focal_mm > 0 && options.sensor_mm > 0) {
    return pinhole(
        focal_of_lens(width, focal_mm, options.sensor_mm),
        options.focal_mm > 0 ? "focal length and sensor given" : "EXIF focal length, sensor given");
  }
  // A 35 mm equivalent is by the diagonal of 36 x 24 mm, as camera makers state it.
  const double diagonal = std::hypot(width, height);
  if (options.focal_mm <= 0 && notes.focal_35mm > 0) {
    return pinhole(notes.focal_35mm * diagonal / std::hypot(36.0, 24.0), "EXIF 35 mm equivalent");
  }
  return pinhole(focal_of_fov(width, radians(kAssumedFov)), kAssumedFocal);
}

}  // namespace sateen::capture
