// SPDX-License-Identifier: MIT
#include "command.h"
#include "commands.h"
#include "sateen/texture/aniso_author.h"

namespace sateen::cli {
namespace {

struct MapsAnisoAuthorArguments {
  std::filesystem::path output;
  std::string style = "uv";
  std::string roughness_u, roughness_v, gloss_u, gloss_v;
  std::string roughness, amount, rotation;
  std::filesystem::path vectors;
  double angle_range = 360;
  std::string encoding = "root";
  int bits = 16;
};

/// A constant angle is in degrees; a map is scaled by --angle-range.
texture::MapInput angle_input(const std::string& text) {
  texture::MapInput input = texture::parse_map_input(text);
  input.value /= 360;
  return input;
}

void refuse(const MapsAnisoAuthorArguments& a, bool uv) {
  const bool uv_given =
      !a.roughness_u.empty() || !a.roughness_v.empty() || !a.gloss_u.empty() || !a.gloss_v.empty();
  const bool other_given = !a.roughness.empty() || !a.amount.empty();
  if (uv && other_given) {
    throw CLI::ValidationError("--roughness and --anisotropy go with the styles other than uv");
  }
  if (!uv && uv_given) throw CLI::ValidationError("--roughness-u, -v and --gloss-u, -v go with --style uv");
  if (uv && (a.roughness_u.empty() != a.roughness_v.empty() || a.gloss_u.empty() != a.gloss_v.empty())) {
    throw CLI::ValidationError("give roughness or gloss along both U and V");
  }
  if (uv && a.roughness_u.empty() == a.gloss_u.empty()) {
    throw CLI::ValidationError("give either --roughness-u and --roughness-v, or --gloss-u and --gloss-v");
  }
  if (!uv && a.roughness.empty()) throw CLI::ValidationError("--style " + a.style + " needs --roughness");
  if (!a.vectors.empty() && !a.rotation.empty() && !texture::parse_map_input(a.rotation).file.empty()) {
    throw CLI::ValidationError("--vectors goes with a constant --rotation, not with a map");
  }
}

void run(const MapsAnisoAuthorArguments& a) {
  texture::AuthorInputs in;
  in.style = texture::anisotropy_style_from_name(a.style);
  const bool uv = in.style == texture::AnisotropyStyle::uv;
  refuse(a, uv);
  if (uv) {
    in.gloss = !a.gloss_u.empty();
    in.along = texture::parse_map_input(in.gloss ? a.gloss_u : a.roughness_u);
    in.across = texture::parse_map_input(in.gloss ? a.gloss_v : a.roughness_v);
  } else {
    in.roughness = texture::parse_map_input(a.roughness);
    // A glTF texture's strength is a factor's to scale: 1 unless told otherwise.
    in.amount = a.amount.empty() ? texture::MapInput{{}, 0, a.vectors.empty() ? 0.0 : 1.0}
                                 : texture::parse_map_input(a.amount);
  }
  if (!a.rotation.empty()) in.rotation = angle_input(a.rotation);
  in.turns_at_one = a.angle_range / 360;
  in.vectors = a.vectors;
  check_outputs({a.output});
  texture::author_anisotropy(in, a.output, texture::anisotropy_encoding_from_name(a.encoding), a.bits,
                             progress_bar("authoring"));
}

}  // namespace

void add_maps_aniso_author(CLI::App& parent) {
  auto a = std::make_shared<MapsAnisoAuthorArguments>();
  CLI::App* command = add_command(
      parent, "author", "Make an anisotropy map from roughness and direction maps",
      "sateen maps aniso author --roughness-u 0.6 --roughness-v 0.3 --rotation 30 -o aniso.png\n\n"
      "Inputs are a value or a picture, with :r, :g, :b or :a for its channel (metal.png:g). Pictures are "
      "data,\n"
      "never sRGB, and of one size. alpha = roughness^2; gloss = 1 - roughness; V and angles run up.");
  command->add_option("-o,--output", a->output, "The anisotropy map: .png or .exr")->required();
  command->add_option("--style", a->style, "Whose meaning the inputs have")
      ->check(CLI::IsMember({"uv", "gltf", "blender", "substance", "materialx", "filament"}));
  command->add_option("--roughness-u", a->roughness_u,
                      "uv: roughness along U (along the rotated axis) [0, 1]");
  command->add_option("--roughness-v", a->roughness_v, "uv: roughness along V (across it) [0, 1]");
  command->add_option("--gloss-u", a->gloss_u, "uv: gloss instead [0, 1]");
  command->add_option("--gloss-v", a->gloss_v, "uv: gloss instead [0, 1]");
  command->add_option("--roughness", a->roughness, "all styles but uv: roughness [0, 1]");
  command->add_option(
      "--anisotropy", a->amount,
      "glTF strength, Blender's anisotropic, Substance's level, the others' anisotropy [0, 1]");
  command->add_option("--rotation", a->rotation,
                      "Angle from U towards V: degrees, or a map whose 1 is --angle-range");
  command->add_option("--angle-range", a->angle_range, "Degrees that a value of 1 in an angle map means");
  command->add_option(
      "--vectors", a->vectors,
      "Direction map, red and green x/2 + 1/2, y/2 + 1/2; the glTF texture with --style gltf");
  command->add_option("--encoding", a->encoding, "Encoding of the map")
      ->check(CLI::IsMember({"root", "correlation"}));
  command->add_option("--bits", a->bits, "Of a PNG")->check(CLI::IsMember({8, 16}));
  command->callback([a] { run(*a); });
}

}  // namespace sateen::cli
