// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sateen/scene/load_scene.h"

namespace sateen::cli {

/// The options that say what is drawn: mesh, materials, tangents, occlusion, maps and the pipeline's
/// switches.
struct SceneArguments {
  std::string mesh;
  std::vector<std::string> materials;
  std::string tangents = "auto";
  double tangent_angle = 0;
  std::string occlusion = "file";
  std::string normal_map;
  double normal_scale = 1;
  std::string direction_map;
  std::string environment;
  double environment_turn = 0;
  std::string perspective = "rotation";
  bool no_cyclic_fix = false;
  bool per_fragment = false;
  bool no_renormalise = false;
};

void add_scene_options(CLI::App& command, SceneArguments& arguments);

/// Reads everything. Throws Error, and CLI::ValidationError for options that are spelled wrongly.
scene::Scene load(const SceneArguments& arguments);

}  // namespace sateen::cli
