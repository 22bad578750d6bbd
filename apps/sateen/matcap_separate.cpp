// SPDX-License-Identifier: MIT
#include <array>
#include <filesystem>

#include "command.h"
#include "commands.h"
#include "matcap_options.h"
#include "sateen/io/image.h"
#include "sateen/matcap/matcap_picture.h"
#include "sateen/matcap/separation.h"

namespace sateen::cli {

void add_matcap_separate(CLI::App& parent) {
  struct MatcapSeparateArguments {
    MatcapArguments matcap;
    std::filesystem::path input;
    std::filesystem::path low;
    std::filesystem::path high;
  };
  auto arguments = std::make_shared<MatcapSeparateArguments>();
  CLI::App* command =
      add_command(parent, "separate", "Split a MatCap into low- and high-frequency parts that add up to it",
                  "sateen matcap separate examples/matcaps/ceramic.exr --low low.exr --high high.exr");
  command->add_option("matcap", arguments->input, "The MatCap, any picture")->required();
  command->add_option("--low", arguments->low, "Low part: .exr (float), .png (16 bit); values as they add up")
      ->required();
  command->add_option("--high", arguments->high, "High part: the MatCap minus the low part")->required();
  add_matcap_options(*command, arguments->matcap);
  command->callback([arguments] {
    const std::array outputs{arguments->low, arguments->high};
    check_outputs({arguments->low, arguments->high});
    const matcap::MatcapPicture picture =
        matcap::read_matcap_picture(arguments->input, disc_of(arguments->matcap));
    const matcap::Separation parts =
        matcap::separate(matcap::to_add_up_space(picture.image, space_of(arguments->matcap)), picture.disc,
                         outliers_of(arguments->matcap), arguments->input.string());
    io::write_data(outputs, std::array{parts.low, parts.high});
  });
}

}  // namespace sateen::cli
