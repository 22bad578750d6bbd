// SPDX-License-Identifier: MIT
#include "sateen/scene/shade.h"

#include <array>
#include <filesystem>
#include <map>

#include "command.h"
#include "commands.h"
#include "display_options.h"
#include "sateen/core/exposure.h"
#include "sateen/io/image.h"
#include "sateen/scene/lighting.h"

namespace sateen::cli {
namespace {

namespace fs = std::filesystem;

struct ShadeArguments {
  std::map<appearance::SurfaceField, fs::path> pictures;
  fs::path material;
  scene::LightingOptions lighting;
  double environment_turn = 0;  ///< degrees
  DisplayArguments display;
  fs::path output;
};

void run(const ShadeArguments& arguments) {
  io::check_image_writable(arguments.output);
  const std::array materials{scene::load_material(arguments.material)};
  scene::LightingOptions lighting = arguments.lighting;
  lighting.environment_turn = radians(arguments.environment_turn);
  scene::ShadeInputs inputs;
  for (const auto& [field, path] : arguments.pictures) {
    if (!path.empty()) inputs[field] = io::read_data(path);
  }
  const appearance::Appearance& appearance = *materials[0].appearance;
  Image picture =
      scene::shade(appearance, inputs, scene::make_lighting(materials, lighting), progress_bar("Shading"));
  const auto display = display_settings(arguments.display, arguments.output, appearance.lit(),
                                        [&] { return automatic_exposure(picture); });
  if (display) picture = displayed(std::move(picture), *display);
  const auto background = background_for(arguments.output, std::nullopt);
  if (background) picture = over_background(std::move(picture), *background);
  io::write_image(arguments.output, picture);
}

}  // namespace

void add_shade(CLI::App& parent) {
  auto arguments = std::make_shared<ShadeArguments>();
  CLI::App* command = add_command(
      parent, "shade", "Shade pictures of normals and tangents with a material, without drawing",
      "sateen shade --normals jacket.normal.exr --tangents jacket.tangent.exr --material silk.ktx2 "
      "-o jacket.exr");
  for (const appearance::SurfaceFieldInfo& field : appearance::surface_fields()) {
    if (field.input.empty()) continue;
    CLI::Option* option =
        command->add_option("--" + std::string(field.input), arguments->pictures[field.field],
                            "Picture of the surface: " + std::string(field.meaning));
    if (field.field == appearance::SurfaceField::normal) option->required();
  }
  command->add_option("--material,-m", arguments->material, "AMC, MatCap picture or .json material")
      ->required();
  CLI::Option* environment =
      command->add_option("--env", arguments->lighting.environment,
                          "Latitude-longitude picture that lights a \"layered\" material");
  command
      ->add_option("--env-rotate", arguments->environment_turn,
                   "Turns it about the vertical, degrees, counter-clockwise seen from above")
      ->needs(environment);
  add_display_options(*command, arguments->display);
  command->add_option("-o,--output", arguments->output, "The picture, RGBA; over white in .jpg and .hdr")
      ->required();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
