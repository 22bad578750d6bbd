// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/capture/capture.h"

namespace sateen::capture {

/// Degrees, horizontal: assumed where nothing is known of the lens; common for webcams.
inline constexpr double kAssumedFov = 60;
/// Camera::focal_source of that assumption, and of what the outline tells instead.
inline constexpr const char* kAssumedFocal = "assumed";
inline constexpr const char* kEstimatedFocal = "estimated from the sphere's outline";

/// The camera from the best source there is: calibration, field of view, focal length and sensor, EXIF, or
/// the assumption (Camera::focal_source is then kAssumedFocal). Throws Error when the calibration is for
/// pictures of another shape.
Camera choose_camera(const FrameSource& source, const CaptureOptions& options);

}  // namespace sateen::capture
