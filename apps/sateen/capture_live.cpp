// SPDX-License-Identifier: MIT
#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "capture_options.h"
#include "command.h"
#include "commands.h"
#include "sateen/amc/amc_file.h"
#include "sateen/capture/rig/live.h"
#include "sateen/core/error.h"

namespace sateen::cli {
namespace {

struct CaptureLiveArguments {
  capture::LiveOptions live;
  capture::GrblOptions grbl;
  std::string stage = "manual";
  std::string camera = "0";
  int settle = 300;
  double turn_seconds = 0;
  std::filesystem::path output;
  CaptureArguments capture;
};

std::unique_ptr<capture::Stage> open_stage(const CaptureLiveArguments& arguments) {
  if (arguments.stage == "continuous")
    return capture::continuous_stage(std::chrono::milliseconds(std::llround(arguments.turn_seconds * 1000)));
  if (arguments.stage == "manual") {
    return capture::manual_stage([](const std::string& text) {
      fmt::print(stderr, "{}: ", text);
      std::string line;
      if (!std::getline(std::cin, line))
        throw Error("no more input: the capture can be resumed with the same command");
    });
  }
  capture::GrblOptions options = arguments.grbl;
  options.settle = std::chrono::milliseconds(arguments.settle);
  return capture::open_grbl_stage(arguments.stage.substr(5), options);
}

void run(const CaptureLiveArguments& arguments) {
  if (!arguments.output.empty()) check_outputs(capture_outputs(arguments.capture, arguments.output));
  capture::CaptureOptions options = capture_options(arguments.capture);
  const auto stage = open_stage(arguments);
  const auto camera = capture::open_live_camera(arguments.camera);
  for (const std::string& warning : camera->warnings()) warn(warning);
  capture::LiveOptions live = arguments.live;
  live.progress = progress_bar("shooting");
  const capture::LiveResult shot = capture::capture_live(*stage, *camera, live);
  if (shot.found > 0)
    warn(fmt::format("{} frames of an earlier capture were kept, {} taken", shot.found, shot.taken));
  if (arguments.output.empty()) return;
  take_stage_angles(arguments.capture, {live.folder}, options);
  capture::CaptureResult result = capture::build_capture({live.folder}, options);
  result.table.amc.provenance["program"] = "sateen " SATEEN_VERSION;
  amc::write_amc(arguments.output, result.table.amc);
  report_capture(arguments.capture, arguments.output, result);
}

}  // namespace

void add_capture_live(CLI::App& parent) {
  auto arguments = std::make_shared<CaptureLiveArguments>();
  CLI::App* command = add_command(
      parent, "live", "Shoot a capture with a camera and a turning stage; resumes what was interrupted",
      "sateen capture live --camera 0 --frames 128 --stage grbl:/dev/ttyUSB0 --folder shots -o cloth.ktx2 "
      "--first-angle 90");
  command
      ->add_option("--folder", arguments->live.folder, "Where the frames go; frames already there are kept")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "The AMC to build when all frames are there; without it only shoot");
  command->add_option("--camera", arguments->camera,
                      "Number of the camera (/dev/videoN), or a video whose frames stand in for one");
  command->add_option("--frames", arguments->live.frames, "Frames over one full turn")
      ->check(CLI::Range(12, 4096));
  command
      ->add_option("--stage", arguments->stage,
                   "grbl:DEVICE, manual (asks for each turn) or continuous (turns by itself)")
      ->check([](const std::string& name) {
        const bool known =
            name == "manual" || name == "continuous" || (name.starts_with("grbl:") && name.size() > 5);
        return known ? std::string() : "must be grbl:DEVICE, manual or continuous";
      });
  command
      ->add_option("--turn-seconds", arguments->turn_seconds,
                   "What one turn of a continuous stage takes; 0: as many frames as the camera gives")
      ->check(CLI::Range(0.0, 86400.0));
  const auto grbl = "GRBL stage";
  command->add_option("--baud", arguments->grbl.baud, "Speed of the serial line")->group(grbl);
  command->add_option("--stage-axis", arguments->grbl.axis, "The axis that turns")->group(grbl);
  command->add_option("--units-per-turn", arguments->grbl.units_per_turn, "Units of that axis in one turn")
      ->check(CLI::PositiveNumber)
      ->group(grbl);
  command->add_option("--feed", arguments->grbl.feed, "Speed in units a minute")
      ->check(CLI::PositiveNumber)
      ->group(grbl);
  command->add_flag("--reverse", arguments->grbl.reverse, "The stage turns clockwise for rising coordinates")
      ->group(grbl);
  command->add_option("--settle", arguments->settle, "Milliseconds to wait after each move")
      ->check(CLI::Range(0, 60000))
      ->group(grbl);
  add_capture_options(*command, arguments->capture);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
