// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sateen/capture/sphere/camera.h"

namespace sateen::capture {

struct Calibration {
  Camera camera;
  double rms_pixels = 0;              ///< of the corners' reprojection
  int used = 0;                       ///< pictures in which the board was found
  std::vector<std::string> unusable;  ///< pictures without a board
};

/// The camera's focal length, principal point and lens distortion from pictures of a flat chessboard with
/// `columns` x `rows` inner corners, held in different poses (Zhang 2000, as in OpenCV). Throws Error when
/// fewer than 5 pictures show the board, when they differ in size, and when the fit is worse than 2 pixels.
Calibration calibrate(const std::vector<std::filesystem::path>& pictures, int columns, int rows);

}  // namespace sateen::capture
