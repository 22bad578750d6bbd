// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "amc_report.h"
#include "command.h"
#include "commands.h"
#include "json_output.h"
#include "sateen/amc/amc_file.h"
#include "sateen/amc/build.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"

namespace sateen::cli {
namespace {

struct AmcBuildArguments {
  FrameArguments frames;
  std::filesystem::path output;
  int slices = 128;
  std::string symmetry = "auto";
  double threshold = amc::kDefaultSymmetryThreshold;
  std::string encoding = "auto";
  bool json = false;
};

amc::AmcEncoding chosen_encoding(const std::string& name, bool floating) {
  if (name == "auto") return floating ? amc::AmcEncoding::half : amc::AmcEncoding::srgb8;
  return name == "half" ? amc::AmcEncoding::half : amc::AmcEncoding::srgb8;
}

void run(const AmcBuildArguments& arguments) {
  check_outputs({arguments.output});
  const amc::LoadedFrames loaded = load(arguments.frames);
  amc::SymmetryReport report = amc::analyse_symmetry(loaded.frames, arguments.threshold);
  amc::BuildAmcOptions options;
  options.slices = arguments.slices;
  options.encoding = chosen_encoding(arguments.encoding, loaded.floating);
  if (arguments.symmetry != "auto") {
    options.symmetry = std::stoi(arguments.symmetry);
    report.noise_removed = amc::noise_removed_by(loaded.frames, *options.symmetry, report.peak);
  }
  amc::AmcTable table = amc::build_amc(loaded.frames, report, options);
  table.provenance = {{"program", "sateen " SATEEN_VERSION},
                      {"frames", std::to_string(loaded.frames.size())},
                      {"skipped_frames", std::to_string(loaded.skipped)},
                      {"first_angle_degrees", fmt::format("{}", arguments.frames.first_angle)},
                      {"direction", arguments.frames.direction},
                      {"symmetry_threshold_db", fmt::format("{}", report.threshold)},
                      {"noise_removed", fmt::format("{:.5f}", report.noise_removed)}};
  for (const amc::Similarity& s : report.similarities) {
    if (s.turns > 1) table.provenance[fmt::format("psnr_r{}_db", s.turns)] = fmt::format("{:.2f}", s.psnr);
  }
  amc::write_amc(arguments.output, table);
  if (arguments.json) {
    nlohmann::json description = to_json(report);
    description["symmetry"] = table.symmetry;
    description["size"] = table.size;
    description["slices"] = table.slices;
    description["frames"] = loaded.frames.size();
    description["skipped"] = loaded.skipped;
    print(json_text(description) + "\n");
  }
}

}  // namespace

void add_amc_build(CLI::App& parent) {
  auto arguments = std::make_shared<AmcBuildArguments>();
  CLI::App* command =
      add_command(parent, "build", "Make an Anisotropic MatCap from rectified frames of a turning sphere",
                  "sateen amc build examples/silk -o silk.ktx2");
  add_frame_options(*command, arguments->frames);
  command
      ->add_option("-o,--output", arguments->output,
                   "The AMC: a .ktx2 file, or a folder of slices (no extension)")
      ->required();
  command->add_option("--slices", arguments->slices, "Tangent angles in one period (S_k)")
      ->check(CLI::Range(1, 2048));
  command
      ->add_option("--symmetry", arguments->symmetry,
                   "R: equivalent turns to average; auto takes the largest the frames show")
      ->check(CLI::IsMember({"auto", "1", "2", "3", "4"}));
  command->add_option("--threshold", arguments->threshold, "PSNR in dB from which a turn counts as alike");
  command
      ->add_option("--encoding", arguments->encoding,
                   "Texels in the file; auto: half for float frames, else srgb8")
      ->check(CLI::IsMember({"auto", "srgb8", "half"}));
  command->add_flag("--json", arguments->json, "Print what was found as JSON");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
