// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/judge.h"
#include "capture/simulator.h"
#include "sateen/capture/report.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::capture_of;
using test::CaptureErrors;
using test::informed_options;
using test::judge;
using test::Simulation;
using test::small_options;
using test::TemporaryFolder;

/// Every nuisance at moderate strength.
Simulation moderate() {
  Simulation s;
  s.frames = 48;
  s.unevenness = 0.6;
  s.tilt = {1.2, -0.8};
  s.wobble = {2.5, 1.5};
  s.drift = 0.03;
  s.colour_drift = 0.01;
  s.noise = 1.5;
  s.seam = true;
  return s;
}

TEST(Capture, ModerateNuisances) {
  const Simulation s = moderate();
  CaptureOptions options = informed_options(s);
  options.table.size = 96;
  const CaptureResult result = capture_of(s, options);
  const CaptureErrors e = judge(result, s);
  EXPECT_LT(e.centre, 0.3);
  EXPECT_LT(e.radius, 0.3);
  EXPECT_LT(e.axis, 0.5);
  EXPECT_LT(e.angle, 0.2);
  EXPECT_LT(e.exposure, 0.004);
  EXPECT_EQ(result.table.amc.symmetry, 2);
  EXPECT_GT(e.table, 40);
  // The seam, found with no hint.
  EXPECT_GT(e.seam_recall, 0.95);
  EXPECT_GT(e.seam_precision, 0.90);
}

/// As a usual camera's, with some noise.
Simulation small() {
  Simulation s = test::small_simulation();
  s.noise = 1;
  return s;
}

std::string complaint(const Simulation& s) {
  try {
    capture_of(s, small_options(s));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Capture, ClockwiseEqualStepsAreRecognised) {
  Simulation s = small();
  s.clockwise = true;
  const CaptureResult result = capture_of(s, small_options(s));
  EXPECT_TRUE(result.turn.equal_steps);
  EXPECT_LT(result.turn.turned, 0);
  EXPECT_LT(judge(result, s).angle, 0.02);
  EXPECT_GT(test::table_psnr(result.table.amc, s, result.table.seen), 36);
}

TEST(Capture, BlurredAndRepeatedFramesAreDropped) {
  Simulation s = small();
  s.noise = 0.5;
  s.shaken = {9};
  s.repeated = {20, 21};
  const CaptureResult result = capture_of(s, small_options(s));
  EXPECT_EQ(result.frames[9].dropped, Dropped::blurred);
  EXPECT_EQ(result.frames[20].dropped, Dropped::same_angle);
  EXPECT_EQ(result.frames[21].dropped, Dropped::same_angle);
  const std::string report = report_json(result);
  EXPECT_THAT(report, testing::HasSubstr(R"("dropped": "blurred")"));
  EXPECT_THAT(report, testing::HasSubstr(R"("dropped": "shows the same angle as the frame before")"));
  EXPECT_THAT(report, testing::HasSubstr(R"("source": "field of view given")"));
  EXPECT_EQ(std::ranges::count_if(result.frames, &CaptureFrame::used), 33);
}

TEST(Capture, StageAnglesAreEnoughWhereTheSurfaceIsPlain) {
  Simulation s = small();
  s.texture = 0;
  s.noise = 0.5;
  const TemporaryFolder folder;
  s.write(folder.path());
  CaptureOptions options = small_options(s);
  options.turn.source = AngleSource::equal;
  EXPECT_GT(test::table_psnr(build_capture({folder.path()}, options).table.amc, s, {}), 36);
  options.turn.source = AngleSource::given;
  for (int i = 0; i < s.frames; ++i) options.turn.angles.push_back(s.angle(i));
  EXPECT_GT(test::table_psnr(build_capture({folder.path()}, options).table.amc, s, {}), 36);
  options.turn.angles.pop_back();
  EXPECT_THROW(build_capture({folder.path()}, options), Error);
}

TEST(Capture, TangentFromTheSeamOrReadOffAFrame) {
  Simulation s = small();
  s.seam = true;
  CaptureOptions options = small_options(s);
  options.tangent.from = ZeroAngle::seam;
  options.tangent.angle = radians(-90);
  const TemporaryFolder folder;
  s.write(folder.path());
  const CaptureResult from_seam = build_capture({folder.path()}, options);
  EXPECT_NEAR(degrees(from_seam.frames[0].angle), s.first_angle, 1);
  options.tangent.from = ZeroAngle::thread;
  options.tangent.frame = 9;
  options.tangent.angle = radians(s.first_angle) + s.angle(9);
  EXPECT_NEAR(degrees(build_capture({folder.path()}, options).frames[0].angle), s.first_angle, 0.5);
}

TEST(Capture, APaintedMaskIsTrackedThroughTheTurn) {
  Simulation s = small();
  s.seam = true;
  const TemporaryFolder folder;
  s.write(folder.path());
  Image paint(s.width, s.height, 1);
  const int painted = 5;
  const SphereView sphere = s.sphere_of(painted);
  const Mat3 back = Eigen::AngleAxisd(-s.angle(painted), s.axis()).toRotationMatrix();
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      Vec3 n;
      if (normal_at_pixel(s.camera(), sphere, {x + 0.5, y + 0.5}, n) && s.in_seam(back * n))
        paint.at(x, y, 0) = 1;
    }
  }
  const TemporaryFolder other;
  io::write_image(other / "mask.png", paint);
  CaptureOptions options = small_options(s);
  options.seams.find_blemishes = false;
  const CaptureResult without = build_capture({folder.path()}, options);
  options.seams.mask = other / "mask.png";
  options.seams.mask_frame = painted;
  const CaptureResult with = build_capture({folder.path()}, options);
  EXPECT_GT(with.seams.mask.share, 0.01);
  EXPECT_GT(test::table_psnr(with.table.amc, s, with.table.seen),
            test::table_psnr(without.table.amc, s, without.table.seen) + 5);
  options.seams.mask_frame = 99;
  EXPECT_THROW(build_capture({folder.path()}, options), Error);
}

TEST(Capture, APostInFrontIsLeftOut) {
  Simulation s = small();
  s.covered = true;
  s.noise = 0.5;
  s.wobble = {2, 1};  // the post stands still, the sphere's picture does not
  const CaptureResult result = capture_of(s, small_options(s));
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("stands still")));
  EXPECT_GT(test::table_psnr(result.table.amc, s, result.table.seen), 33);
}

TEST(Capture, ExposureAndColourDriftAreRemoved) {
  Simulation s = small();
  s.drift = 0.2;
  s.colour_drift = 0.05;
  const CaptureResult result = capture_of(s, small_options(s));
  EXPECT_LT(judge(result, s).exposure, 0.01);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("exposure changes")));
  EXPECT_GT(test::table_psnr(result.table.amc, s, result.table.seen), 35);
}

TEST(Capture, ClippedHighlightsAreReported) {
  Simulation s = small();
  s.exposure = 2;
  const CaptureResult result = capture_of(s, small_options(s));
  EXPECT_GT(result.clipping.share, 0.01);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("clipped")));
}

TEST(Capture, AVideoGivesTheTableOfItsPictures) {
  Simulation s = small();
  s.noise = 0;
  const TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi");
  const CaptureResult result = build_capture({folder / "turn.avi"}, small_options(s));
  EXPECT_EQ(result.frames.size(), 36);
  EXPECT_GT(test::table_psnr(result.table.amc, s, result.table.seen), 35);

  // An index that promises frames the file no longer has.
  auto bytes = io::read_bytes(folder / "turn.avi");
  bytes.resize(bytes.size() / 4);
  io::write_bytes(folder / "cut.avi", bytes);
  EXPECT_THROW(build_capture({folder / "cut.avi"}, small_options(s)), Error);
  io::write_text(folder / "none.mp4", "no video at all");
  EXPECT_THROW(build_capture({folder / "none.mp4"}, small_options(s)), Error);
}

TEST(CaptureComplaints, NoSphere) {
  Simulation s = small();
  s.sphere = false;
  EXPECT_THAT(complaint(s), testing::HasSubstr("no sphere"));
}

TEST(CaptureComplaints, TwoSpheres) {
  Simulation s = small();
  s.centre = {275, 112};
  s.second_sphere = true;
  EXPECT_THAT(complaint(s), testing::HasSubstr("two turning spheres"));
}

TEST(CaptureComplaints, IncompleteTurn) {
  Simulation s = small();
  s.turn = 300;
  EXPECT_THAT(complaint(s), testing::HasSubstr("turn is not complete"));
}

TEST(CaptureComplaints, CutByTheEdge) {
  Simulation s = small();
  s.centre = {350, 112};
  EXPECT_THAT(complaint(s), testing::HasSubstr("cut by the picture's edge"));
}

TEST(CaptureComplaints, CameraMoved) {
  Simulation s = small();
  s.camera_move = {6, 3};
  EXPECT_THAT(complaint(s), testing::HasSubstr("camera moved"));
}

TEST(CaptureComplaints, TooFewFrames) {
  Simulation s = small();
  s.frames = 3;
  EXPECT_THAT(complaint(s), testing::HasSubstr("only 3 frames"));
}

TEST(CaptureComplaints, NothingToRegister) {
  Simulation s = small();
  s.texture = 0;
  s.noise = 0.5;
  EXPECT_THAT(complaint(s), testing::HasSubstr("--angles"));
}

TEST(CaptureComplaints, FilesThatAreWrong) {
  Simulation s = small();
  s.frames = 14;
  const TemporaryFolder folder;
  s.write(folder.path());
  auto bytes = io::read_bytes(folder / "frame_003.png");
  bytes.resize(bytes.size() / 2);
  io::write_bytes(folder / "frame_003.png", bytes);
  EXPECT_THROW(build_capture({folder.path()}, small_options(s)), Error);
  io::write_image(folder / "frame_003.png", Image(40, 30, 3, 0.5f));
  EXPECT_THROW(build_capture({folder.path()}, small_options(s)), Error);
  EXPECT_THROW(build_capture({folder / "missing"}, small_options(s)), Error);
}

}  // namespace
}  // namespace sateen::capture
