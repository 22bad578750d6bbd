// SPDX-License-Identifier: MIT
#include "sateen/scene/shade.h"

#include <filesystem>

#include "command.h"
#include "commands.h"
#include "display_options.h"
#include "sateen/core/exposure.h"
#include "sateen/io/image.h"
#include "sateen/light/environment.h"
#include "sateen/scene/registry.h"

namespace sateen::cli {
namespace {

namespace fs = std::filesystem;

struct ShadeArguments {
  fs::path normals;
  fs::path tangents;
  fs::path positions;
  fs::path occlusion;
  fs::path uvs;
  fs::path curvature;
  fs::path mesh_normals;
  fs::path material;
  fs::path environment;
  DisplayArguments display;
  fs::path output;
};

void run(const ShadeArguments& arguments) {
  const auto appearance =
      arguments.environment.empty()
          ? scene::load_appearance(arguments.material)
          : scene::load_appearance(arguments.material, light::read_environment(arguments.environment));
  const auto read = [](const fs::path& path) { return path.empty() ? Image() : io::read_data(path); };
  const scene::ShadeInputs inputs{.normals = read(arguments.normals),
                                  .tangents = read(arguments.tangents),
                                  .positions = read(arguments.positions),
                                  .occlusion = read(arguments.occlusion),
                                  .uvs = read(arguments.uvs),
                                  .curvature = read(arguments.curvature),
                                  .mesh_normals = read(arguments.mesh_normals)};
  Image picture = scene::shade(*appearance, inputs, progress_bar("Shading"));
  const auto display = display_settings(arguments.display, arguments.output, lit(*appearance),
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
  command
      ->add_option("--normals", arguments->normals,
                   "View-space normals as stored, row 0 on top; zero is empty")
      ->required();
  command->add_option("--tangents", arguments->tangents,
                      "View-space tangents, for materials that have a direction");
  command->add_option(
      "--positions", arguments->positions,
      "View-space positions with the eye at the origin; without them the view is orthographic");
  command->add_option("--occlusion", arguments->occlusion,
                      "Ambient occlusion in the first channel, 1 is open");
  command->add_option("--uv", arguments->uvs, "Texture coordinates, v up, for materials with textures");
  command->add_option("--curvature", arguments->curvature,
                      "Curvature in the first channel, positive where convex");
  command->add_option("--mesh-normals", arguments->mesh_normals,
                      "Normals before any normal map, for materials that smooth theirs");
  command->add_option("--material,-m", arguments->material, "AMC, MatCap picture or .json material")
      ->required();
  command->add_option("--env", arguments->environment,
                      "Latitude-longitude picture that lights a \"layered\" material");
  add_display_options(*command, arguments->display);
  command->add_option("-o,--output", arguments->output, "The picture, RGBA; over white in .jpg and .hdr")
      ->required();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sateen::cli
