// SPDX-License-Identifier: MIT
#include "command.h"
#include "commands.h"
#include "sateen/amc/amc_file.h"

namespace sateen::cli {

void add_amc_convert(CLI::App& parent) {
  struct AmcConvertArguments {
    std::filesystem::path input;
    std::filesystem::path output;
    std::string encoding = "keep";
  };
  auto arguments = std::make_shared<AmcConvertArguments>();
  CLI::App* command =
      add_command(parent, "convert", "Change an AMC's encoding, or between .ktx2 and a folder of slices",
                  "sateen amc convert silk.ktx2 -o silk_slices");
  command->add_option("amc", arguments->input, "The AMC: .ktx2 or a folder of slices")->required();
  command->add_option("-o,--output", arguments->output, "A .ktx2 file, or a folder (no extension)")
      ->required();
  command->add_option("--encoding", arguments->encoding, "Texels of the output")
      ->check(CLI::IsMember({"keep", "srgb8", "half"}));
  command->callback([arguments] {
    check_outputs({arguments->output});
    amc::AmcTable table = amc::read_amc(arguments->input);
    if (arguments->encoding != "keep") {
      table.encoding = arguments->encoding == "half" ? amc::AmcEncoding::half : amc::AmcEncoding::srgb8;
      amc::quantise(table);
    }
    amc::write_amc(arguments->output, table);
  });
}

}  // namespace sateen::cli
