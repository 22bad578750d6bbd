// SPDX-License-Identifier: MIT
#include <filesystem>

#include <fmt/format.h>

#include "command.h"
#include "commands.h"
#include "parse.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "sateen/matcap/bake.h"
#include "sateen/matcap/decomposition_file.h"
#include "sateen/matcap/edits.h"

namespace sateen::cli {
namespace {

struct MatcapBakeArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path edits;
  std::string turn;
  int size = 0;
  bool layers = false;
  std::string environment;
  int environment_height = 512;
};

void run(const MatcapBakeArguments& arguments) {
  if (arguments.layers && !arguments.environment.empty()) {
    throw CLI::ValidationError("--layers", "and --environment exclude each other");
  }
  if (arguments.layers && io::extension_of(arguments.output) != ".exr") {
    throw CLI::ValidationError("--layers", "only .exr has layers");
  }
  io::check_image_writable(arguments.output);
  std::vector<matcap::Edit> edits;
  if (!arguments.edits.empty()) edits = matcap::read_edits(arguments.edits);
  if (!arguments.turn.empty())
    edits.push_back(matcap::Turn{parse_vector("--turn", arguments.turn) * (kPi / 180)});
  matcap::EditedMatcap matcap = matcap::apply_edits(matcap::read_matcap(arguments.input), edits);
  if (arguments.size > 0) {
    matcap.matcap.width = matcap.matcap.height = arguments.size;
    matcap.matcap.disc = matcap::inscribed_disc(arguments.size, arguments.size);
  }
  if (arguments.layers) {
    auto layers = matcap::bake_layers(matcap);
    io::write_layers(arguments.output, std::vector<io::ImageLayer>{{"diffuse", std::move(layers[0])},
                                                                   {"specular", std::move(layers[1])}});
  } else if (!arguments.environment.empty()) {
    const matcap::Part part = arguments.environment == "low" ? matcap::Part::low : matcap::Part::high;
    io::write_image(arguments.output, matcap::bake_environment(matcap, part, arguments.environment_height));
  } else {
    io::write_image(arguments.output, matcap::bake(matcap));
  }
}

}  // namespace

void add_matcap_bake(CLI::App& parent) {
  auto arguments = std::make_shared<MatcapBakeArguments>();
  CLI::App* command =
      add_command(parent, "bake", "Turn a decomposed MatCap, edited or not, back into pictures",
                  "sateen matcap bake decomposed/lead.ktx2 --turn 0,40,0 -o lead_turned.png");
  command->add_option("matcap", arguments->input, "The .ktx2 that decompose wrote")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture: .png, .exr, .jpg, .tif or .hdr, of the input's size")
      ->required();
  command->add_option("--edits", arguments->edits, "JSON list of edits, see docs/matcap-decomposition.md");
  command->add_option("--turn", arguments->turn,
                      "X,Y,Z: turn the light by these degrees about x, then y, then z, after the edits");
  command
      ->add_option("--size", arguments->size,
                   "A square picture of so many pixels that the sphere fills; 0: as the input")
      ->check(CLI::Range(0, 8192));
  command->add_flag("--layers", arguments->layers, "Write an .exr with the layers diffuse and specular");
  command
      ->add_option("--environment", arguments->environment,
                   "Write the light of this part, low or high, as a latitude-longitude map")
      ->check(CLI::IsMember({"low", "high"}));
  command->add_option("--environment-height", arguments->environment_height, "Rows of that map")
      ->check(CLI::Range(4, 8192));
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
