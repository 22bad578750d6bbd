// SPDX-License-Identifier: MIT
#include "sateen/render/surface_program.h"

#include <array>

#include <fmt/format.h>

namespace sateen::render {
namespace {

std::string define(scene::TangentAngle mode) {
  switch (mode) {
    case scene::TangentAngle::vertex:
      return "TANGENT_ANGLE_VERTEX";
    case scene::TangentAngle::naive:
      return "TANGENT_ANGLE_NAIVE";
    case scene::TangentAngle::fragment:
      break;
  }
  return "TANGENT_ANGLE_FRAGMENT";
}

std::string define(scene::Perspective mode) {
  switch (mode) {
    case scene::Perspective::equation4:
      return "PERSPECTIVE_EQUATION4";
    case scene::Perspective::none:
      return "PERSPECTIVE_NONE";
    case scene::Perspective::rotation:
      break;
  }
  return "PERSPECTIVE_ROTATION";
}

std::string define(bool on) {
  return on ? "true" : "false";
}

gpu::ShaderFile file_of(const appearance::ShaderText& text) {
  return text.text.empty() ? gpu::shader_file(text.name) : gpu::ShaderFile{text.name, text.text};
}

}  // namespace

SurfaceProgram::SurfaceProgram(const scene::Material& material, const scene::RenderSwitches& switches,
                               Output output)
    : module(material.appearance->shader()) {
  const bool surface = output == Output::surface;
  const bool lit = !module.point.empty();
  const bool mapped = material.normal_map.texture || material.direction_map.texture;
  text.defines = {
      {"TANGENT_ANGLE", define(mapped ? scene::TangentAngle::fragment : switches.tangent_angle)},
      {"TANGENT_SYMMETRY", fmt::format("{}.0", material.appearance->tangent_symmetry())},
      {"PERSPECTIVE", define(switches.perspective)},
      {"RENORMALISE", define(switches.renormalise)},
      {"OCCLUSION", define(switches.occlusion)},
      {"NORMAL_MAP", define(material.normal_map.texture != nullptr)},
      {"DIRECTION_MAP", define(material.direction_map.texture != nullptr)},
      {"OCCLUSION_MAP", define(material.occlusion_map.texture != nullptr)},
      {"WRITE_SURFACE", surface ? "1" : "0"},
      {"CURVATURE", surface || material.appearance->needs().curvature ? "1" : "0"},
  };
  if (module.covers) text.defines.emplace_back("SURFACE_COVER", module.entry + "_cover");
  std::vector<gpu::ShaderFile> files;
  if (!surface || module.covers) {
    text.defines.insert(text.defines.end(), module.defines.begin(), module.defines.end());
    for (const appearance::ShaderText& own : module.texts) files.push_back(file_of(own));
  }
  if (!surface) {
    text.defines.emplace_back("APPEARANCE", lit ? "lit" : module.entry);
    if (lit) {
      text.defines.emplace_back("REFLECTANCE_POINT", module.point);
      text.defines.emplace_back("REFLECTANCE_AT", module.entry + "_at");
      text.defines.emplace_back("REFLECTANCE_LIT", module.entry + "_lit");
      text.defines.emplace_back("REFLECTANCE_SURROUNDINGS", module.entry + "_surroundings");
      files.push_back(gpu::shader_file("lit.glsl"));
    }
  }
  files.push_back(gpu::shader_file("surface.frag"));
  text.vertex = gpu::with_needed(std::array{gpu::shader_file("surface.vert")});
  text.fragment = gpu::with_needed(files);
  text.attributes = vertex_attributes();
}

const std::vector<std::string>& vertex_attributes() {
  static const std::vector<std::string> names{
      "in_position", "in_normal", "in_tangent", "in_map_tangent", "in_curvature_diagonal", "in_curvature_off",
#define SURFACE_FIELD(...)
#define SURFACE_VERTEX_FIELD(type, glsl, name, ...) "in_" #name,
#include "sateen/appearance/surface_fields.h"
  };
  return names;
}

}  // namespace sateen::render
