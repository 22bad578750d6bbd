// SPDX-License-Identifier: MIT
#include <filesystem>

#include <fmt/format.h>

#include "command.h"
#include "commands.h"
#include "matcap_options.h"
#include "parse.h"
#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/matcap/batch.h"
#include "sateen/matcap/contact_sheet.h"

namespace sateen::cli {
namespace {

namespace fs = std::filesystem;

struct MatcapDecomposeArguments {
  MatcapArguments matcap;
  std::vector<fs::path> inputs;
  fs::path output;
  int map_size = 0;
  bool anew = false;
  std::string shard = "1/1";
};

void run(const MatcapDecomposeArguments& arguments) {
  matcap::DecomposeFileOptions options;
  options.decompose.space = space_of(arguments.matcap);
  options.decompose.outliers = outliers_of(arguments.matcap);
  options.decompose.regions = regions_of(arguments.matcap);
  options.decompose.map_size = arguments.map_size;
  options.disc = disc_of(arguments.matcap);
  options.program = "sateen " SATEEN_VERSION;
  check_outputs({arguments.output});
  const auto inputs = io::expand_inputs(arguments.inputs, io::image_extensions());
  if (io::extension_of(arguments.output) == ".ktx2") {
    if (inputs.size() != 1) {
      throw CLI::ValidationError("--output",
                                 fmt::format("{} MatCaps need a folder, not one .ktx2", inputs.size()));
    }
    matcap::decompose_file(inputs[0], arguments.output, options);
    return;
  }
  if (arguments.output.has_extension()) {
    throw CLI::ValidationError("--output", "must be a .ktx2 or a folder (a name without extension)");
  }
  const auto [number, count] = parse_shard("--shard", arguments.shard);
  const auto entries = matcap::decompose_files(inputs, arguments.output, options, arguments.anew,
                                               progress_bar("Decomposing"), {number, count});
  matcap::write_contact_sheet(arguments.output, entries, progress_bar("Contact sheet"));
  std::string failures;
  int failed = 0;
  int tried = 0;
  for (const matcap::BatchEntry& entry : entries) {
    tried += entry.elsewhere ? 0 : 1;
    if (entry.failure.empty()) continue;
    ++failed;
    failures += "\n  " + entry.failure;
  }
  if (failed > 0)
    throw Error(fmt::format("{} of {} MatCaps could not be decomposed:{}", failed, tried, failures));
}

}  // namespace

void add_matcap_decompose(CLI::App& parent) {
  auto arguments = std::make_shared<MatcapDecomposeArguments>();
  CLI::App* command =
      add_command(parent, "decompose", "Take MatCaps apart, so that their light and material can be changed",
                  "sateen matcap decompose examples/matcaps -o decomposed");
  command->add_option("matcaps", arguments->inputs, "MatCaps, or folders of them")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "A .ktx2 for one MatCap, or a folder for NAME.ktx2 and the contact sheet index.html")
      ->required();
  command
      ->add_option("--map-size", arguments->map_size,
                   "Texels across the sphere maps; 0: the sphere's diameter in pixels, at most 1024")
      ->check(CLI::Range(0, 4096));
  command->add_flag("--anew", arguments->anew, "Make outputs again that an earlier run has finished");
  command
      ->add_option("--shard", arguments->shard,
                   "I/N: take every N-th MatCap from the I-th on, so that N machines share a folder")
      ->type_name("I/N");
  add_region_options(*command, arguments->matcap);
  add_matcap_options(*command, arguments->matcap);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
