// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sateen/io/picture8.h"

namespace sateen::io {

class CameraSource;

/// A camera of the system (V4L2), with its exposure, white balance and focus held where they settle.
class Camera {
 public:
  /// Throws Error when no camera of that number answers, or the module for cameras is not installed.
  explicit Camera(int index);
  ~Camera();
  Camera(Camera&&) noexcept;
  Camera& operator=(Camera&&) noexcept;

  /// A picture taken now. Throws Error when the camera is gone.
  Picture8 shoot();
  /// What its driver does not let be held ("exposure").
  std::vector<std::string> not_fixed() const;

 private:
  std::unique_ptr<CameraSource> frames_;
};

}  // namespace sateen::io
