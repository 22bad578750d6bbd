// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sateen/capture/rig/stage.h"
#include "sateen/core/progress.h"
#include "sateen/io/picture8.h"

namespace sateen::capture {

/// What takes the pictures.
class LiveCamera {
 public:
  virtual ~LiveCamera() = default;
  /// A picture taken after this call, not one buffered before it. Throws Error when the camera is gone.
  virtual io::Picture8 shoot() = 0;
  /// What could not be fixed (exposure, white balance), for the user.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// A number is camera /dev/videoN through V4L2, exposure and white balance fixed where the driver allows.
/// Anything else is a video file that stands in for a camera, one frame a shot. Throws Error when there is
/// none.
std::unique_ptr<LiveCamera> open_live_camera(const std::string& name);

struct LiveOptions {
  int frames = 128;
  std::filesystem::path folder;  ///< where frame_000.png ... and capture.json go
  Progress progress;
};

struct LiveResult {
  int taken = 0;                ///< now
  int found = 0;                ///< frames an interrupted capture had left
  std::vector<double> degrees;  ///< per frame, as in capture.json; empty unless the stage knew them all
};

/// Moves, waits, shoots, next: `frames` pictures over one full turn. A capture interrupted at any moment
/// leaves only whole frames; calling again with the same folder takes only those that are missing, the stage
/// standing where the last was taken. Throws Error from stage and camera, for a full disk, and when the
/// folder holds a capture of another number of frames.
LiveResult capture_live(Stage& stage, LiveCamera& camera, const LiveOptions& options);

/// The angles (degrees, counter-clockwise, one a frame) that a live capture left in its folder; empty when
/// there is none or its stage did not know them. Throws Error when capture.json is damaged.
std::vector<double> stage_angles(const std::filesystem::path& folder);

}  // namespace sateen::capture
