// SPDX-License-Identifier: MIT
#include "scene_options.h"

#include "command.h"
#include "parse.h"

namespace sateen::cli {
namespace {

scene::TangentSource tangent_source(const SceneArguments& arguments) {
  scene::TangentSource source;
  source.angle = radians(arguments.tangent_angle);
  const std::string& text = arguments.tangents;
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos && kind == "auto") return source;
  if (colon == std::string::npos && kind == "uv") {
    source.kind = scene::TangentSource::Kind::uv;
    return source;
  }
  if (colon == std::string::npos || (kind != "around" && kind != "along")) {
    throw CLI::ValidationError(
        "--tangents",
        "\"" + text +
            "\" is not understood; write auto, uv, around:AXIS or along:AXIS, AXIS being x, y, z or X,Y,Z");
  }
  source.kind = kind == "around" ? scene::TangentSource::Kind::around : scene::TangentSource::Kind::along;
  source.axis = parse_axis("--tangents", text.substr(colon + 1)).cast<float>();
  return source;
}

scene::RenderSwitches switches(const SceneArguments& arguments) {
  scene::RenderSwitches result;
  if (arguments.no_cyclic_fix) result.tangent_angle = scene::TangentAngle::naive;
  if (arguments.per_fragment) result.tangent_angle = scene::TangentAngle::fragment;
  if (arguments.perspective == "equation4") result.perspective = scene::Perspective::equation4;
  if (arguments.perspective == "none") result.perspective = scene::Perspective::none;
  result.renormalise = !arguments.no_renormalise;
  return result;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneArguments& arguments) {
  command.add_option("mesh", arguments.mesh, "The mesh: OBJ, PLY, GLB or glTF")->required();
  command
      .add_option("--material,-m", arguments.materials,
                  "AMC (.ktx2 or a folder of slices), MatCap picture or .json material; NAME=FILE for one "
                  "material of the "
                  "mesh; may be repeated")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--tangents", arguments.tangents,
                     "auto (the file's, else from UVs), uv, around:AXIS or along:AXIS (x, y, z or X,Y,Z)");
  command.add_option("--tangent-angle", arguments.tangent_angle,
                     "Turns all tangents, degrees; 90 swaps warp and weft");
  command.add_option("--occlusion", arguments.occlusion,
                     "Ambient occlusion: file (the mesh's own), none, compute, or a picture laid on by UV");
  command.add_option("--normal-map", arguments.normal_map,
                     "Tangent-space normal map, green up; a glTF's own is used without this");
  command.add_option("--normal-scale", arguments.normal_scale, "Strength of normal maps");
  command.add_option("--direction-map", arguments.direction_map,
                     "Tangent directions as RG = 0.5 + 0.5 * direction along (u, v)");
  CLI::Option* environment = command.add_option(
      "--env", arguments.environment,
      "Latitude-longitude picture (.hdr, .exr) that lights \"layered\" materials; its middle is behind "
      "the object");
  command
      .add_option("--env-rotate", arguments.environment_turn,
                  "Turns it about the vertical, degrees, counter-clockwise seen from above")
      ->needs(environment);
  command.add_option("--perspective", arguments.perspective, "How directions are corrected for perspective")
      ->check(CLI::IsMember({"rotation", "equation4", "none"}));
  CLI::Option* naive =
      command.add_flag("--no-cyclic-fix", arguments.no_cyclic_fix,
                       "Interpolate tangent angles across their cut, as Figure 9 of the paper shows");
  command
      .add_flag("--per-fragment", arguments.per_fragment,
                "Interpolate tangents and take their angle in the fragment; always so under normal and "
                "direction maps")
      ->excludes(naive);
  command.add_flag("--no-renormalise", arguments.no_renormalise, "Leave interpolated normals shorter than 1");
}

scene::Scene load(const SceneArguments& arguments) {
  scene::SceneOptions options;
  for (const std::string& text : arguments.materials) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      options.material = text;
    } else {
      options.materials[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }
  options.tangents = tangent_source(arguments);
  if (arguments.occlusion == "none") {
    options.occlusion = scene::OcclusionSource::none;
  } else if (arguments.occlusion == "compute") {
    options.occlusion = scene::OcclusionSource::compute;
  } else if (arguments.occlusion != "file") {
    options.occlusion_map = arguments.occlusion;
  }
  options.normal_map = arguments.normal_map;
  options.normal_scale = static_cast<float>(arguments.normal_scale);
  options.direction_map = arguments.direction_map;
  options.lighting = {arguments.environment, radians(arguments.environment_turn)};
  options.warn = warn;
  options.switches = switches(arguments);
  options.progress = progress_bar("Preparing");
  return scene::load_scene(arguments.mesh, options);
}

}  // namespace sateen::cli
