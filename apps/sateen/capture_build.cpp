// SPDX-License-Identifier: MIT
#include "capture_options.h"
#include "command.h"
#include "commands.h"
#include "sateen/amc/amc_file.h"
#include "sateen/capture/report.h"

namespace sateen::cli {
namespace {

struct CaptureBuildArguments {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  CaptureArguments capture;
  bool json = false;
};

void run(const CaptureBuildArguments& arguments) {
  check_outputs(capture_outputs(arguments.capture, arguments.output));
  capture::CaptureOptions options = capture_options(arguments.capture);
  take_stage_angles(arguments.capture, arguments.inputs, options);
  options.progress = progress_bar("capture");
  capture::CaptureResult result = capture::build_capture(arguments.inputs, options);
  result.table.amc.provenance["program"] = "sateen " SATEEN_VERSION;
  amc::write_amc(arguments.output, result.table.amc);
  report_capture(arguments.capture, arguments.output, result);
  if (arguments.json) print(capture::report_json(result));
}

}  // namespace

void add_capture_build(CLI::App& parent) {
  auto arguments = std::make_shared<CaptureBuildArguments>();
  CLI::App* command =
      add_command(parent, "build",
                  "Make an Anisotropic MatCap from photographs or a video of a turning, cloth-covered sphere",
                  "sateen capture build photos -o cloth.ktx2 --report report --focal-mm 70 --sensor-mm 36 "
                  "--first-angle 90");
  command->add_option("inputs", arguments->inputs, "Photographs, folders of photographs, or one video")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The AMC: a .ktx2 file, or a folder of slices (no extension)")
      ->required();
  add_capture_options(*command, arguments->capture);
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
