// SPDX-License-Identifier: MIT
// Captures under the strains a real rig puts on them, against the simulator's truth.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "capture/judge.h"
#include "sateen/capture/turning/sphere_registration.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::capture_of;
using test::CaptureErrors;
using test::informed_options;
using test::judge;
using test::Simulation;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Simulation mid_sized() {
  Simulation s;
  s.width = 480;
  s.height = 288;
  s.focal = 936;
  s.centre = {255, 137};
  s.radius = 88;
  s.frames = 40;
  s.noise = 1;
  s.samples = 1;
  return s;
}

TEST(CaptureTurning, AnAxisTiltedByFiveDegreesIsFound) {
  Simulation s = mid_sized();
  s.tilt = {3, -4};
  s.unevenness = 0.6;
  const CaptureResult result = capture_of(s, informed_options(s));
  const CaptureErrors errors = judge(result, s);
  EXPECT_LT(errors.axis, 0.5);
  EXPECT_LT(errors.angle, 0.2);
  EXPECT_GT(errors.table, 36);
  EXPECT_THAT(result.warnings, Not(Contains(HasSubstr("doubtful"))));
}

TEST(CaptureTurning, AnglesThatThePicturesContradictAreDoubted) {
  Simulation s = mid_sized();
  CaptureOptions options = informed_options(s);
  options.turn.source = AngleSource::given;
  for (int i = 0; i < s.frames; ++i)
    options.turn.angles.push_back(s.angle(i) + radians(6) * std::sin(s.angle(i)));
  EXPECT_THAT(capture_of(s, options).warnings, Contains(HasSubstr("doubtful")));
}

TEST(CaptureTurning, AnglesOfAnotherDirectionOrTurnAreTold) {
  Simulation s = mid_sized();
  s.tilt = {4, 0};
  CaptureOptions options = informed_options(s);
  options.turn.source = AngleSource::equal;
  EXPECT_THAT(capture_of(s, options).warnings, Not(Contains(HasSubstr("the table is wrong"))));
  options.turn.clockwise = true;
  EXPECT_THAT(capture_of(s, options).warnings, Contains(HasSubstr("turns the other way")));
  options.turn.source = AngleSource::given;
  for (int i = 0; i < s.frames; ++i) options.turn.angles.push_back(2 * s.angle(i));
  EXPECT_THAT(capture_of(s, options).warnings, Contains(HasSubstr("not those of the pictures")));
}

TEST(CaptureTurning, HeavyNoiseIsAveragedOut) {
  Simulation s = mid_sized();
  s.noise = 5;
  s.unevenness = 0.5;
  const CaptureResult result = capture_of(s, informed_options(s));
  const CaptureErrors errors = judge(result, s);
  EXPECT_LT(errors.centre, 0.3);
  EXPECT_LT(errors.radius, 0.3);
  EXPECT_LT(errors.axis, 0.5);
  EXPECT_LT(errors.angle, 0.2);
}

TEST(CaptureTurning, BlackFramesAreLeftOutWithAWarning) {
  Simulation s = mid_sized();
  s.black = {0, 14, 15};
  CaptureOptions options = informed_options(s);
  options.tangent.from = ZeroAngle::thread;
  options.tangent.frame = 1;
  options.tangent.angle += s.angle(1);
  const CaptureResult result = capture_of(s, options);
  for (const int i : s.black) EXPECT_EQ(result.frames[static_cast<std::size_t>(i)].dropped, Dropped::dark);
  EXPECT_EQ(std::ranges::count_if(result.frames, &CaptureFrame::used), 37);
  EXPECT_THAT(result.warnings, Contains(AllOf(HasSubstr("left out"), HasSubstr("frame_014.png"))));
  EXPECT_GT(judge(result, s).table, 36);
}

TEST(CaptureTurning, WhatTheSeamHidesIsMeasuredHalfATurnOn) {
  Simulation s = mid_sized();
  s.seam = true;
  const test::TemporaryFolder folder;
  s.write(folder.path());
  CaptureOptions options = informed_options(s);
  options.table.symmetry = 1;
  const CaptureResult without = build_capture({folder.path()}, options);
  options.table.symmetry = 2;
  const CaptureResult with = build_capture({folder.path()}, options);
  EXPECT_GT(with.table.seen_share, without.table.seen_share + 0.01);
  // All texels, however they came to be known.
  EXPECT_GT(test::table_psnr(with.table.amc, s, {}), test::table_psnr(without.table.amc, s, {}) + 1);
}

TEST(CaptureTurning, PortraitGreyAndNear) {
  Simulation s = mid_sized();
  std::swap(s.width, s.height);
  s.centre = {141, 250};
  s.grey = true;
  s.focal = 480;
  s.clockwise = true;
  const CaptureResult result = capture_of(s, informed_options(s));
  const CaptureErrors errors = judge(result, s);
  EXPECT_LT(result.turn.turned, 0);
  EXPECT_LT(errors.centre, 0.3);
  EXPECT_LT(errors.radius, 0.3);
  EXPECT_LT(errors.angle, 0.2);
  EXPECT_GT(errors.table, 36);
}

TEST(CaptureTurning, ADamagedPhotographIsNamed) {
  Simulation s = mid_sized();
  s.frames = 14;
  const test::TemporaryFolder folder;
  for (int i = 0; i < s.frames; ++i) {
    io::Picture8 picture = s.render(i);
    cv::imwrite((folder / (fmt::format("f{}.jpg", 10 + i))).string(),
                cv::Mat(s.height, s.width, CV_8UC3, picture.rgb.data()));
  }
  auto bytes = io::read_bytes(folder / "f15.jpg");
  bytes.resize(bytes.size() / 2);
  io::write_bytes(folder / "f15.jpg", bytes);
  try {
    build_capture({folder.path()}, informed_options(s));
    FAIL() << "took a damaged photograph";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("f15.jpg"));
  }
}

}  // namespace
}  // namespace sateen::capture
