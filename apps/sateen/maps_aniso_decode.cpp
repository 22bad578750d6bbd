// SPDX-License-Identifier: MIT
#include "command.h"
#include "commands.h"
#include "sateen/texture/aniso_author.h"

namespace sateen::cli {
namespace {

struct MapsAnisoDecodeArguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::string style = "alphas";
  std::string encoding = "root";
  int bits = 16;
};

}  // namespace

void add_maps_aniso_decode(CLI::App& parent) {
  auto a = std::make_shared<MapsAnisoDecodeArguments>();
  CLI::App* command = add_command(
      parent, "decode", "Turn an anisotropy map back into what other programs read",
      "sateen maps aniso decode aniso.png --style blender -o roughness_anisotropic_rotation.png\n\n"
      "Channels: alphas: alpha_t, alpha_b, angle / 180; uv: roughness along, across, angle / 180;\n"
      "gltf: direction x, y, strength, and NAME_roughness; blender: roughness, anisotropic, turns;\n"
      "substance: roughness, level, turns; materialx, filament: roughness, anisotropy, turns.");
  command->add_option("input", a->input, "The anisotropy map")->required();
  command->add_option("-o,--output", a->output, "A .png or .exr")->required();
  command->add_option("--style", a->style, "Whose meaning the output has")
      ->check(CLI::IsMember({"alphas", "uv", "gltf", "blender", "substance", "materialx", "filament"}));
  command->add_option("--encoding", a->encoding, "Encoding of the map")
      ->check(CLI::IsMember({"root", "correlation"}));
  command->add_option("--bits", a->bits, "Of a PNG")->check(CLI::IsMember({8, 16}));
  command->callback([a] {
    check_outputs({a->output});
    texture::decode_anisotropy_map(a->input, texture::anisotropy_encoding_from_name(a->encoding),
                                   texture::decode_style_from_name(a->style), a->output, a->bits,
                                   progress_bar("decoding"));
  });
}

}  // namespace sateen::cli
