// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/choose_lens.h"

#include <cmath>

#include <fmt/format.h>

#include "sateen/capture/photographs/lens_notes.h"
#include "sateen/core/error.h"

namespace sateen::capture {
namespace {

/// The calibrated camera for pictures of `width` x `height`.
Camera fitted(const Camera& calibrated, int width, int height) {
  const double factor = static_cast<double>(width) / calibrated.width;
  if (std::abs(calibrated.height * factor - height) > 1.5) {
    throw Error(fmt::format("the calibration is for pictures of {} x {}, these are {} x {}: another shape",
                            calibrated.width, calibrated.height, width, height));
  }
  Camera camera = calibrated.scaled(factor);
  camera.width = width;
  camera.height = height;
  return camera;
}

}  // namespace

Lens choose_lens(const FrameSource& source, const LensOptions& options) {
  const int width = source.width();
  const int height = source.height();
  if (options.camera) return {fitted(*options.camera, width, height), FocalSource::calibration, {}};
  const auto pinhole = [&](double focal, FocalSource from) {
    return Lens{Camera::pinhole(width, height, focal), from, {}};
  };
  if (options.fov > 0) return pinhole(focal_of_fov(width, options.fov), FocalSource::field_of_view);
  const LensNotes notes = source.is_video() ? LensNotes{} : read_lens_notes(source.path(0));
  const double focal_mm = options.focal_mm > 0 ? options.focal_mm : notes.focal_mm;
  if (focal_mm > 0 && options.sensor_mm > 0) {
    return pinhole(focal_of_lens(width, focal_mm, options.sensor_mm),
                   options.focal_mm > 0 ? FocalSource::lens_and_sensor : FocalSource::exif_and_sensor);
  }
  // A 35 mm equivalent is by the diagonal of 36 x 24 mm, as camera makers state it.
  const double diagonal = std::hypot(width, height);
  if (options.focal_mm <= 0 && notes.focal_35mm > 0)
    return pinhole(notes.focal_35mm * diagonal / std::hypot(36.0, 24.0), FocalSource::exif_35mm);
  return pinhole(focal_of_fov(width, radians(kAssumedFov)), FocalSource::assumed);
}

}  // namespace sateen::capture
