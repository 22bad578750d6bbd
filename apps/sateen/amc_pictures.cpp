// SPDX-License-Identifier: MIT
#include "command.h"
#include "commands.h"
#include "sateen/amc/amc_file.h"
#include "sateen/amc/sheet.h"
#include "sateen/io/image.h"

namespace sateen::cli {
namespace {

struct AmcPicturesArguments {
  std::filesystem::path input;
  std::filesystem::path output;
};

/// A command that reads an AMC and writes the picture `draw` makes of it.
void add_picture_command(CLI::App& parent, const char* name, const char* summary, const char* example,
                         Image (*draw)(const amc::AmcTable&)) {
  auto arguments = std::make_shared<AmcPicturesArguments>();
  CLI::App* command = add_command(parent, name, summary, example);
  command->add_option("amc", arguments->input, "The AMC: .ktx2 or a folder of slices")->required();
  command->add_option("-o,--output", arguments->output, "The picture: .png or .exr")->required();
  command->callback([arguments, draw] {
    io::check_image_writable(arguments->output);
    io::write_image(arguments->output, draw(amc::read_amc(arguments->input)));
  });
}

}  // namespace

void add_amc_pictures(CLI::App& parent) {
  add_picture_command(parent, "isotropic",
                      "Average all slices into the isotropic MatCap nearest to the material",
                      "sateen amc isotropic silk.ktx2 -o matcap.png", amc::isotropic_average);
  add_picture_command(parent, "slices", "Draw a contact sheet: slices and the two orthogonal cuts",
                      "sateen amc slices silk.ktx2 -o sheet.png",
                      [](const amc::AmcTable& table) { return amc::contact_sheet(table); });
}

}  // namespace sateen::cli
