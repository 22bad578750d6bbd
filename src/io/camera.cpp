// SPDX-License-Identifier: MIT
#include "sateen/io/camera.h"

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/module.h"

namespace sateen::io {

Camera::Camera(int index) : frames_(camera_module("a camera").open_camera(index)) {
  if (!frames_) {
    throw Error(fmt::format(
        "no camera {} answers (V4L2); look at /dev/video* and whether another program uses it", index));
  }
}

Camera::~Camera() = default;
Camera::Camera(Camera&&) noexcept = default;
Camera& Camera::operator=(Camera&&) noexcept = default;

Picture8 Camera::shoot() {
  Picture8 picture;
  // The driver may still hold frames from before it was asked.
  const bool shot = frames_->skip() && frames_->skip() && frames_->next(picture);
  if (!shot) throw Error("the camera delivers no more pictures; is it still plugged in?");
  return picture;
}

std::vector<std::string> Camera::not_fixed() const {
  return frames_->not_fixed();
}

}  // namespace sateen::io
