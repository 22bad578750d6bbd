// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>

#include "sateen/core/vector.h"

namespace sateen::capture {

/// A pinhole camera with the Brown-Conrady lens distortion. Pixel coordinates run right and down from the
/// picture's top left corner, pixel centres at +0.5; rays live in view space (x right, y up, the camera looks
/// along -z).
struct Camera {
  int width = 0;
  int height = 0;
  Vec2 focal{0, 0};                    ///< pixels, along x and y
  Vec2 principal{0, 0};                ///< pixels
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3 as OpenCV orders them; all 0: none

  /// A distortion-free camera with the principal point in the middle; `focal_pixels` for both axes.
  static Camera pinhole(int width, int height, double focal_pixels);

  bool distorted() const;

  /// Unit direction from the eye through a pixel.
  Vec3 ray(const Vec2& pixel) const;

  /// Pixel of a view-space point or direction in front of the camera (z < 0).
  Vec2 project(const Vec3& point) const;

  /// The same camera for the picture scaled by `factor` (0.5: half as wide).
  Camera scaled(double factor) const;
};

/// Focal length in pixels of a picture `width` pixels wide taken with a lens of `focal_mm` on a sensor
/// `sensor_mm` wide, or with a horizontal field of view of `fov` radians.
double focal_of_lens(int width, double focal_mm, double sensor_mm);
double focal_of_fov(int width, double fov);

/// A camera as JSON (written by `sateen capture calibrate`). Throws Error naming the file when it is missing,
/// no such JSON, or has impossible values.
Camera read_camera(const std::filesystem::path& path);
void write_camera(const std::filesystem::path& path, const Camera& camera, double rms_pixels);

}  // namespace sateen::capture
