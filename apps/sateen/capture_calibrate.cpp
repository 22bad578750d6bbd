// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/capture/sphere/calibrate.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen::cli {
namespace {

struct CaptureCalibrateArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  int columns = 9;
  int rows = 6;
  bool json = false;
};

void run(const CaptureCalibrateArguments& arguments) {
  check_outputs({arguments.output});
  const auto files = io::expand_inputs(arguments.inputs, io::image_extensions());
  const capture::Calibration found = capture::calibrate(files, arguments.columns, arguments.rows);
  for (const std::string& file : found.unusable)
    warn(fmt::format("{}: no whole chessboard found, left out", file));
  capture::write_camera(arguments.output, found.camera, found.rms_pixels);
  if (!arguments.json) return;
  const nlohmann::ordered_json report{{"focal", {found.camera.focal.x(), found.camera.focal.y()}},
                                      {"principal", {found.camera.principal.x(), found.camera.principal.y()}},
                                      {"distortion", found.camera.distortion},
                                      {"rms_pixels", found.rms_pixels},
                                      {"used", found.used},
                                      {"left_out", found.unusable}};
  print(json_text(report) + "\n");
}

}  // namespace

void add_capture_calibrate(CLI::App& parent) {
  auto arguments = std::make_shared<CaptureCalibrateArguments>();
  CLI::App* command =
      add_command(parent, "calibrate", "Measure a camera's lens with pictures of a chessboard",
                  "sateen capture calibrate boards --columns 9 --rows 6 -o camera.json");
  command
      ->add_option("inputs", arguments->inputs,
                   "Pictures of a flat chessboard in at least 5 poses, or a folder")
      ->required();
  command->add_option("-o,--output", arguments->output, "The camera, for --calibration (JSON)")->required();
  command->add_option("--columns", arguments->columns, "Inner corners in a row of the board")
      ->check(CLI::Range(3, 100));
  command->add_option("--rows", arguments->rows, "Inner corners in a column of the board")
      ->check(CLI::Range(3, 100));
  command->add_flag("--json", arguments->json, "Print what was found as JSON");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
