// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sateen/amc/table.h"
#include "sateen/capture/sphere/camera.h"
#include "sateen/capture/sphere/sphere_view.h"
#include "sateen/core/image.h"
#include "sateen/io/picture8.h"

namespace sateen::test {

/// A capture of known truth with every nuisance at adjustable strength. The material is an analytic function
/// of the eye-frame normal and tangent: two lobes along the threads and a diffuse part, alike under half a
/// turn.
struct Simulation {
  int width = 640;
  int height = 360;
  double focal = 1250;    // pixels
  Vec2 centre{345, 171};  // of the sphere, mean over the turn, pixels
  double radius = 112;    // pixels
  int frames = 64;
  double turn = 360;      // degrees in all
  double unevenness = 0;  // of the steps, as a share of a step, uniform
  bool clockwise = false;
  double first_angle = 25;     // degrees, of the tangent in the first frame
  Vec2 tilt{0, 0};             // degrees by which the axis misses the eye, across and up
  Vec2 wobble{0, 0};           // pixels by which the sphere's centre misses the axis, in the first frame
  double texture = 0.05;       // of the surface, as a share of its light
  double drift = 0;            // of the exposure, largest share
  double colour_drift = 0;     // of red against blue
  double noise = 0;            // of the sensor, standard deviation in 8-bit codes
  double blur = 0.5;           // of the lens, standard deviation in pixels
  bool seam = false;           // a dark wedge at the pole
  double lamp_distance = 1e6;  // in sphere radii
  double exposure = 1;         // of all: above 1.5 highlights clip
  bool stand = true;
  bool covered = false;       // by a post in front of the sphere's lower part
  std::vector<int> shaken;    // frames that are blurred
  std::vector<int> repeated;  // frames that repeat the one before
  std::vector<int> black;     // frames that show nothing but noise
  Vec2 camera_move{0, 0};     // pixels by which the picture jumps half-way
  bool second_sphere = false;
  bool sphere = true;
  bool grey = false;  // photographs without colour
  int samples = 2;    // along each side of a pixel inside the sphere
  std::uint32_t seed = 7;

  capture::Camera camera() const { return capture::Camera::pinhole(width, height, focal); }
  Vec3 axis() const;
  double angle(int frame) const;  // radians turned since the first frame
  capture::SphereView sphere_of(int frame) const;
  Vec3 gain(int frame) const;
  bool in_seam(const Vec3& body) const;  // body normal at angle 0, view space
  io::Picture8 render(int frame) const;
  /// Every frame as a PNG in `folder`.
  void write(const std::filesystem::path& folder) const;

  /// The light of the material for an eye-frame normal and tangent, exposure included.
  Vec3 material(const Vec3& normal, const Vec3& tangent) const;
};

/// Small and quick, for what does not depend on precision.
Simulation small_simulation(int frames = 36);

/// The frames, or only those in [first, end), as a Motion JPEG video.
void write_video(const Simulation& simulation, const std::filesystem::path& path);
void write_video(const Simulation& simulation, const std::filesystem::path& path, int first, int end);

/// A picture of a chessboard with `columns` x `rows` inner corners, squares of side 1, turned and then moved
/// in view space.
void draw_chessboard(const std::filesystem::path& path, const capture::Camera& camera, const Mat3& turned,
                     const Vec3& moved, int columns, int rows);

/// Peak signal-to-noise ratio (dB, peak 1) of a table against the material inside 0.97 of the disc.
double table_psnr(const amc::AmcTable& table, const Simulation& truth, const std::vector<std::uint8_t>& seen);

}  // namespace sateen::test
