// SPDX-License-Identifier: MIT
// The commands from end to end: what a person types, and what lies on the disk afterwards.
#include <chrono>
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

TEST(CaptureCommand, OptionsOfTurnTableAndLightAreHeeded) {
  Simulation s = test::small_simulation(24);
  s.clockwise = true;
  const test::TemporaryFolder folder;
  s.write(folder.path());
  std::string angles;
  for (int i = 0; i < 24; ++i) angles += fmt::format("{}\n", -15 * i);
  io::write_text(folder / "angles.txt", angles);
  const std::string output = (folder / "cloth.ktx2").string();
  const auto built = [&](const std::string& options) {
    const auto result = run_program(
        fmt::format("capture build {} -o {} --report {} --first-angle 25 --encoding half --symmetry 1 "
                    "--perspective view {} {}",
                    folder.path().string(), output, folder.path().string(), lens_and_size(s), options));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return amc::read_amc(output);
  };
  const amc::AmcTable table = built("--angles equal --direction cw --response linear");
  auto report = report_in(folder.path());
  EXPECT_EQ(report["turn"]["direction"], "clockwise");
  EXPECT_NEAR(report["frames"][6]["turned_degrees"].get<double>(), 270, 1e-3);
  EXPECT_NEAR(report["frames"][6]["angle_degrees"].get<double>(), 295, 1e-3);
  EXPECT_EQ(report["symmetry"]["R"], 1);
  EXPECT_EQ(table.symmetry, 1);
  EXPECT_EQ(table.encoding, amc::AmcEncoding::half);
  EXPECT_EQ(table.provenance.at("table_frame"), "view");

  const amc::AmcTable squared = built("--angles " + (folder / "angles.txt").string() + " --response gamma:2");
  report = report_in(folder.path());
  EXPECT_NEAR(report["frames"][6]["turned_degrees"].get<double>(), 270, 1e-3);
  const double code = table.texel(20, 26, 5).y();
  EXPECT_NEAR(squared.texel(20, 26, 5).y(), code * code, 0.03);
}

/// How long `capture live` takes for what is missing of twelve frames when the first `there` have been shot.
double seconds_of_live(int there, const std::string& options) {
  const Simulation s = test::small_simulation();
  const test::TemporaryFolder folder;
  test::write_video(s, folder / "turn.avi", 0, 12 - there);
  std::filesystem::create_directory(folder / "shots");
  for (int i = 0; i < there; ++i)
    io::write_text(folder / "shots" / fmt::format("frame_{:03}.png", i), "a picture, nobody looks");
  const auto begin = std::chrono::steady_clock::now();
  const auto result =
      run_program(fmt::format("capture live --camera {} --frames 12 --folder {} {}",
                              (folder / "turn.avi").string(), (folder / "shots").string(), options));
  EXPECT_EQ(result.exit_code, 0) << result.output;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(CaptureCommand, AStageIsWaitedForAsLongAsAsked) {
  SimulatedGrbl grbl;
  EXPECT_GT(seconds_of_live(11, fmt::format("--stage grbl:{} --settle 1500", grbl.device())), 1.5);
  // From one frame to the next a twelfth of a turn.
  EXPECT_GT(seconds_of_live(10, "--stage continuous --turn-seconds 6"), 0.5);
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
