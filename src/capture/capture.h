// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sateen/amc/symmetry.h"
#include "sateen/amc/table.h"
#include "sateen/capture/exposure/photometry.h"
#include "sateen/capture/photographs/frame_source.h"
#include "sateen/capture/sphere/camera.h"
#include "sateen/capture/sphere/focal_estimate.h"
#include "sateen/capture/table/assemble.h"
#include "sateen/capture/table/stack.h"
#include "sateen/capture/table/surface_mask.h"
#include "sateen/core/progress.h"

namespace sateen::capture {

/// Where the frames' turning angles come from.
enum class AngleSource {
  pictures,  ///< registered from the pictures; equal steps are recognised
  equal,     ///< equal steps over one full turn, the direction as CaptureOptions::clockwise says
  given,     ///< CaptureOptions::angles, from the stage
};

/// What fixes the tangent's direction in the first frame.
enum class ZeroAngle {
  first_frame,  ///< CaptureOptions::zero_angle is the tangent's picture-plane angle in the first frame
  thread,       ///< it is that of frame `zero_frame`: read off the picture in the middle of the sphere
  seam,   ///< the tangent is `zero_angle` from the direction in which the seam lies, seen from the middle
  weave,  ///< the visible weave's own direction in the middle, plus `zero_angle`
};

struct CaptureOptions {
  FrameSourceOptions source;
  int size = 128;    ///< S
  int slices = 128;  ///< S_k over one period
  amc::AmcEncoding encoding = amc::AmcEncoding::half;
  TableFrame frame = TableFrame::eye;
  std::optional<int> symmetry;                                 ///< R to enforce; otherwise detected
  double symmetry_threshold = amc::kDefaultSymmetryThreshold;  ///< dB

  std::optional<Camera> camera;  ///< from a calibration; scaled to the pictures
  double focal_mm = 0;           ///< 0: unknown
  double sensor_mm = 0;          ///< 0: unknown
  double fov = 0;                ///< horizontal, radians; 0: unknown

  AngleSource angle_source = AngleSource::pictures;
  std::vector<double> angles;  ///< radians, counter-clockwise, one for each frame
  bool clockwise = false;      ///< only for AngleSource::equal

  ZeroAngle zero = ZeroAngle::first_frame;
  bool zero_given = false;  ///< otherwise a warning says that zero_angle is arbitrary
  double zero_angle = 0;    ///< radians, counter-clockwise with y up
  int zero_frame = 0;

  std::filesystem::path mask;  ///< a painted mask; empty: none
  int mask_frame = 0;
  bool find_blemishes = true;
  std::filesystem::path mirror_ball;  ///< a picture of a chrome ball on the same stand; empty: none
  double mirror_reflectance = 0.6;    ///< of chrome
  Progress progress;
};

/// What one frame turned out to be.
struct CaptureFrame {
  std::string file;
  double angle = 0;    ///< radians in [0, 2 pi): the tangent's picture-plane angle in the middle of the disc
  double turned = 0;   ///< radians since the first frame, counter-clockwise
  Vec2 centre{0, 0};   ///< SphereView::centre_pixel, pixels from the picture's top left corner
  double radius = 0;   ///< SphereView::radius_pixel
  Vec3 gain{1, 1, 1};  ///< light relative to the capture's mean, R, G, B
  double sharpness = 0;   ///< relative to the median frame
  double confidence = 0;  ///< of the registration
  std::string dropped;    ///< why the frame is not used; empty: it is
};

struct CaptureResult {
  amc::AmcTable table;
  Camera camera;
  std::optional<FocalEstimate> focal;  ///< where nothing told the focal length: what `camera` then has
  SphereView sphere;                   ///< mean over the turn
  Vec3 axis{0, 0, 1};                  ///< of the turning, view space
  double wobble = 0;                   ///< pixels: radius of the circle the sphere's centre describes
  double wobble_rms = 0;               ///< pixels: what is left after that circle
  double outline_support = 0;          ///< share of the outline that stands out against the background
  std::vector<CaptureFrame> frames;
  bool equal_steps = false;
  double turned = 0;  ///< radians in all
  Photometry photometry;
  amc::SymmetryReport symmetry;
  SurfaceMask mask;
  double clipped_share = 0;        ///< of all samples
  double seen_share = 0;           ///< of table entries inside the disc that were measured, not filled
  std::vector<std::uint8_t> seen;  ///< AssembledSlices::seen
  std::string zero_source;         ///< in words
  Image preview;                   ///< the first used frame, light, at most about 960 pixels wide
  int preview_frame = 0;
  Image environment;  ///< from the mirror ball, latitude-longitude (light/environment.h); empty: none
  Image clipped;      ///< size x size, 1 channel: share of the frames in which a texel is clipped
  std::vector<std::string> warnings;  ///< in plain words with what to do
};

inline constexpr int kFewestCaptureFrames = 12;

/// From photographs or a video of a turning sphere to an Anisotropic MatCap (Magri et al., section 5).
/// Decodes everything twice, keeps a few frames in memory. Throws Error, in plain words, for what a user can
/// get wrong.
CaptureResult build_capture(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options);

}  // namespace sateen::capture
