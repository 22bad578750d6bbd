// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sateen/io/picture8.h"

namespace sateen::io {

/// The frames of a camera, as they come.
class CameraSource {
 public:
  virtual ~CameraSource() = default;
  /// The next frame; false when there is none.
  virtual bool next(Picture8& frame) = 0;
  /// Passes over the next frame without converting it.
  virtual bool skip() = 0;
  /// What could not be held fixed ("exposure").
  virtual std::vector<std::string> not_fixed() const = 0;
};

/// What the module sateen-camera does, by way of OpenCV.
struct CameraModule {
  static constexpr const char* kName = "sateen-camera";
  const char* version;  ///< of Sateen

  /// A camera of the system (V4L2), its exposure, white balance and focus held where they settle; null when
  /// none answers.
  std::unique_ptr<CameraSource> (*open_camera)(int index);
};

}  // namespace sateen::io
