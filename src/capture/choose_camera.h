// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/capture.h"

namespace sateen {

/// Degrees, horizontal: assumed where nothing is known of the lens; common for webcams.
inline constexpr double kAssumedFov = 60;

/// The camera from the best source there is: calibration, field of view, focal length and sensor, EXIF, or
/// the assumption (Camera::focal_source is then "assumed"). Throws Error when the calibration is for pictures
/// of another shape.
Camera choose_camera(const FrameSource& source, const CaptureOptions& options);

}  // namespace sateen
