// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sateen/capture/sphere/camera.h"
#include "sateen/capture/sphere/focal_estimate.h"

namespace sateen::capture {

/// What the user knows of the lens.
struct LensOptions {
  std::optional<Camera> camera;  ///< from a calibration; scaled to the pictures
  double focal_mm = 0;           ///< 0: unknown
  double sensor_mm = 0;          ///< width; 0: unknown
  double fov = 0;                ///< horizontal, radians; 0: unknown
};

/// How the focal length came to be known.
enum class FocalSource {
  calibration,
  field_of_view,    ///< LensOptions::fov
  lens_and_sensor,  ///< LensOptions::focal_mm and sensor_mm
  exif_and_sensor,  ///< the focal length from EXIF, LensOptions::sensor_mm
  exif_35mm,        ///< EXIF says what it would be on 35 mm film
  outline,          ///< estimated from the ellipse of the sphere's outline
  assumed,          ///< nothing tells: what cameras commonly have
};

/// In words, for reports.
const char* words(FocalSource source);

/// The camera of a capture and how well its focal length is known.
struct Lens {
  Camera camera;
  FocalSource source = FocalSource::assumed;
  std::optional<FocalEstimate> estimate;  ///< where nothing told the focal length: what `camera` then has
};

/// Degrees, horizontal: assumed where nothing is known of the lens; common for webcams.
inline constexpr double kAssumedFov = 60;

}  // namespace sateen::capture
