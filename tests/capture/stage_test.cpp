// SPDX-License-Identifier: MIT
#include "sateen/capture/rig/stage.h"

#include <chrono>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/simulated_grbl.h"
#include "io/full_disk.h"
#include "sateen/capture/rig/live.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using std::chrono::milliseconds;
using test::SimulatedGrbl;

GrblOptions quick() {
  GrblOptions options;
  options.answer_timeout = milliseconds(2000);
  options.move_timeout = milliseconds(900);
  options.settle = milliseconds(0);
  return options;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GrblStage, MovesAndWaitsUntilItStands) {
  SimulatedGrbl grbl;
  GrblOptions options = quick();
  options.units_per_turn = 8;
  const auto stage = open_grbl_stage(grbl.device(), options);
  stage->move_to(90);
  EXPECT_NEAR(grbl.position, 2, 1e-9);
  options.reverse = true;
  open_grbl_stage(grbl.device(), options)->move_to(45);
  EXPECT_NEAR(grbl.position, -1, 1e-9);
}

TEST(GrblStage, TakesAnswersInPieces) {
  SimulatedGrbl grbl;
  grbl.slow = true;
  open_grbl_stage(grbl.device(), quick())->move_to(10);
  EXPECT_EQ(grbl.moves, 1);
}

TEST(GrblStage, UnlocksOneAlarmAndTellsOfTheNext) {
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  grbl.alarms = 1;
  stage->move_to(10);
  EXPECT_EQ(grbl.moves, 1);
  grbl.alarms = 2;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("ALARM:1"));
}

// An alarm while a resumed capture tells the stage where it stands ended the program.
TEST(GrblStage, AlarmsOnResumingAreUnlockedOnceOrTold) {
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  grbl.alarms_on_position = 1;
  stage->stands_at(40);
  EXPECT_NEAR(grbl.position, 40, 1e-9);
  grbl.alarms_on_position = 2;
  EXPECT_THAT(message_of([&] { stage->stands_at(50); }), testing::HasSubstr("ALARM:3"));
}

TEST(GrblStage, TellsOfRestartsRefusalsAndStandstill) {
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  grbl.restart_on_move = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("restarted"));
  grbl.restart_on_move = false;
  grbl.refuse = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("error:9"));
  grbl.refuse = false;
  grbl.never_idle = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("come to rest"));
  grbl.silent = true;
  EXPECT_THAT(message_of([&] { stage->move_to(20); }), testing::HasSubstr("does not answer"));
}

TEST(GrblStage, TellsWhenNothingOrNoneOfItsKindIsThere) {
  EXPECT_THROW(open_grbl_stage("/dev/no-such-line", quick()), Error);
  SimulatedGrbl grbl;
  grbl.silent = true;
  EXPECT_THAT(message_of([&] { open_grbl_stage(grbl.device(), quick()); }),
              testing::HasSubstr("greets as GRBL"));
}

/// Pictures of one grey; gives up after some.
class CountingCamera final : public LiveCamera {
 public:
  explicit CountingCamera(int good) : good_(good) {}
  io::Picture8 shoot() override {
    if (good_-- <= 0) throw Error("unplugged");
    return {4, 3, std::vector<std::uint8_t>(36, 100)};
  }

 private:
  int good_;
};

TEST(CaptureLive, ResumesWithoutLosingFrames) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder / "shots";
  options.frames = 12;
  SimulatedGrbl grbl;
  const auto stage = open_grbl_stage(grbl.device(), quick());
  CountingCamera failing(5);
  EXPECT_THROW(capture_live(*stage, failing, options), Error);
  CountingCamera camera(100);
  const auto again = open_grbl_stage(grbl.device(), quick());
  const LiveResult result = capture_live(*again, camera, options);
  EXPECT_EQ(result.found, 5);
  EXPECT_EQ(result.taken, 7);
  EXPECT_EQ(result.degrees.size(), 12);
  EXPECT_EQ(stage_angles(options.folder), result.degrees);
  EXPECT_NEAR(grbl.position, 330, 1e-9);
  const std::vector<std::string> extensions{".png"};
  EXPECT_EQ(io::expand_inputs({options.folder}, extensions).size(), 12);
  options.frames = 16;
  EXPECT_THROW(capture_live(*again, camera, options), Error);
}

TEST(CaptureLive, FramesShotByHandLeaveNoAnglesToTheRest) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder.path();
  options.frames = 12;
  CountingCamera failing(5);
  const auto by_hand = manual_stage([](const std::string&) {});
  EXPECT_THROW(capture_live(*by_hand, failing, options), Error);
  SimulatedGrbl grbl;
  CountingCamera camera(100);
  EXPECT_TRUE(capture_live(*open_grbl_stage(grbl.device(), quick()), camera, options).degrees.empty());
  EXPECT_TRUE(stage_angles(options.folder).empty());
}

TEST(CaptureLive, TellsWhatToDoByHand) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder.path();
  options.frames = 12;
  std::vector<std::string> prompts;
  const auto stage = manual_stage([&](const std::string& text) { prompts.push_back(text); });
  CountingCamera camera(100);
  capture_live(*stage, camera, options);
  ASSERT_EQ(prompts.size(), 12);
  EXPECT_THAT(prompts[1], testing::HasSubstr("30.0 degrees"));
}

TEST(CaptureLive, AContinuousTurnIsShotInTime) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder.path();
  options.frames = 12;
  CountingCamera camera(100);
  const auto start = std::chrono::steady_clock::now();
  capture_live(*continuous_stage(milliseconds(240)), camera, options);
  // Eleven of the twelve steps lie between the first and the last frame.
  EXPECT_GE(std::chrono::steady_clock::now() - start, milliseconds(219));
}

/// Pictures of noise, which compress badly, after a few plain ones.
class GrowingCamera final : public LiveCamera {
 public:
  explicit GrowingCamera(int plain) : plain_(plain) {}
  io::Picture8 shoot() override {
    io::Picture8 picture{64, 48, std::vector<std::uint8_t>(64 * 48 * 3, 100)};
    if (plain_-- > 0) return picture;
    for (std::uint8_t& code : picture.rgb) code = static_cast<std::uint8_t>(random_());
    return picture;
  }

 private:
  int plain_;
  std::minstd_rand random_;
};

TEST(CaptureLive, AFullDiskInTheMiddleLeavesOnlyWholeFramesAndIsResumed) {
  const test::TemporaryFolder folder;
  LiveOptions options;
  options.folder = folder.path();
  options.frames = 12;
  const auto stage = continuous_stage(milliseconds(0));
  GrowingCamera camera(5);
  {
    const test::FullDisk full(4096);
    EXPECT_THAT(message_of([&] { capture_live(*stage, camera, options); }),
                testing::AllOf(testing::HasSubstr("frame_005.png"), testing::HasSubstr("same command")));
  }
  const std::vector<std::string> extensions{".png"};
  EXPECT_EQ(io::expand_inputs({options.folder}, extensions).size(), 5);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 6);  // and capture.json
  const LiveResult result = capture_live(*stage, camera, options);
  EXPECT_EQ(result.found, 5);
  EXPECT_EQ(result.taken, 7);
}

TEST(LiveCamera, AVideoStandsInForOne) {
  EXPECT_THROW(open_live_camera("/no/such/video.mp4"), Error);
  EXPECT_THAT(message_of([] { open_live_camera("63"); }), testing::HasSubstr("no camera 63"));
}

}  // namespace
}  // namespace sateen::capture
