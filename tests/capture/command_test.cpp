// SPDX-License-Identifier: MIT
// The commands from end to end: what a person types, and what lies on the disk afterwards.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture/simulated_grbl.h"
#include "capture/simulator.h"
#include "sateen/amc/amc_file.h"
#include "sateen/core/direction.h"
#include "sateen/io/file.h"
#include "support/files.h"

namespace sateen::capture {
namespace {

using test::run_program;
using test::SimulatedGrbl;
using test::Simulation;
using testing::HasSubstr;

std::string lens_and_size(const Simulation& s) {
  return fmt::format(" --fov {:.4f} --size 48 --slices 24", degrees(2 * std::atan(s.width / 2.0 / s.focal)));
}

nlohmann::json report_in(const std::filesystem::path& folder) {
  return nlohmann::json::parse(io::read_text(folder / "report.json"));
}

TEST(CaptureCommand, ALiveCaptureGoesOnAfterAnInterruptionAndMakesTheTable) {
  const Simulation s = test::small_simulation();
  const test::TemporaryFolder folder;
  SimulatedGrbl grbl;
  test::write_video(s, folder / "before.avi", 0, 20);
  test::write_video(s, folder / "after.avi", 20, 36);
  const auto shoot = [&](const std::string& camera) {
    return run_program(fmt::format(
        "capture live --camera {} --frames 36 --stage grbl:{} --settle 0 --folder {} -o {} --report {} "
        "--first-angle 25 {}",
        (folder / camera).string(), grbl.device(), (folder / "shots").string(),
        (folder / "cloth.ktx2").string(), (folder / "report").string(), lens_and_size(s)));
  };
  const auto interrupted = shoot("before.avi");
  EXPECT_EQ(interrupted.exit_code, 1);
  EXPECT_THAT(interrupted.output, HasSubstr("no more frames"));
  EXPECT_FALSE(std::filesystem::exists(folder / "cloth.ktx2"));
  EXPECT_NEAR(grbl.position, 200, 1e-9);

  const auto resumed = shoot("after.avi");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
  EXPECT_THAT(resumed.output, HasSubstr("20 frames of an earlier capture were kept, 16 taken"));
  EXPECT_GT(test::table_psnr(amc::read_amc(folder / "cloth.ktx2"), s, {}), 34);
  const auto report = report_in(folder / "report");
  ASSERT_EQ(report["frames"].size(), 36);
  EXPECT_EQ(report["frames"][35]["file"], "frame_035.png");
  // The stage's angles, not those of the pictures.
  EXPECT_NEAR(report["frames"][9]["turned_degrees"].get<double>(), 90, 1e-3);
  for (const char* field : {"file", "angle_degrees", "center", "radius", "exposure"})
    EXPECT_TRUE(report["frames"][0].contains(field)) << field;
  EXPECT_EQ(report["frames"][0]["center"].size(), 2);
}

TEST(CaptureCommand, AHandIsToldHowFarToTurn) {
  const Simulation s = test::small_simulation();
  const test::TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi", 0, 12);
  io::write_text(folder / "keys", std::string(12, '\n'));
  const std::string command =
      fmt::format("capture live --camera {} --frames 12 --stage manual --folder {} < {}",
                  (folder / "turn.avi").string(), (folder / "shots").string(), (folder / "keys").string());
  const auto shot = run_program(command);
  EXPECT_EQ(shot.exit_code, 0) << shot.output;
  EXPECT_THAT(shot.output, HasSubstr("Turn the sphere to about 330.0 degrees"));
  EXPECT_TRUE(std::filesystem::exists(folder / "shots" / "frame_011.png"));
}

TEST(CaptureCommand, TellsOfAStageThatIsNone) {
  const auto result = run_program("capture live --stage grbl:/dev/no-such-line --folder /tmp/never-made");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output, HasSubstr("/dev/no-such-line"));
  EXPECT_EQ(run_program("capture live --stage sideways --folder /tmp/never-made").exit_code, 2);
}

}  // namespace
}  // namespace sateen::capture
