// SPDX-License-Identifier: MIT
#include "sateen/render/surface_pipeline.h"

#include <fmt/format.h>

#include "sateen/render/geometry_buffers.h"

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

gpu::Program compile(const scene::Material& material, const appearance::ShaderBinding& shader,
                     const scene::RenderSwitches& switches, bool write_surface) {
  const bool mapped = material.normal_map.texture || material.direction_map.texture;
  const gpu::Defines defines{
      {"APPEARANCE", shader.function},
      {"TANGENT_ANGLE", define(mapped ? scene::TangentAngle::fragment : switches.tangent_angle)},
      {"TANGENT_SYMMETRY", fmt::format("{}.0", material.appearance->tangent_symmetry())},
      {"PERSPECTIVE", define(switches.perspective)},
      {"RENORMALISE", define(switches.renormalise)},
      {"OCCLUSION", define(switches.occlusion)},
      {"NORMAL_MAP", define(material.normal_map.texture != nullptr)},
      {"DIRECTION_MAP", define(material.direction_map.texture != nullptr)},
      {"OCCLUSION_MAP", define(material.occlusion_map.texture != nullptr)},
      {"WRITE_SURFACE", define(write_surface)},
  };
  std::vector<std::string> files = shader.files;
  files.emplace_back("surface.frag");
  const std::vector<std::string> vertex{"surface.vert"};
  return {gpu::with_needed(vertex), gpu::with_needed(files), defines, GeometryBuffers::attributes()};
}

}  // namespace

SurfacePipeline::SurfacePipeline(const scene::Material& material, int index,
                                 const scene::RenderSwitches& switches, bool write_surface)
    : program_(compile(material, material.appearance->shader(), switches, write_surface)) {
  const appearance::ShaderBinding shader = material.appearance->shader();
  program_.use();
  for (const appearance::UniformBinding& uniform : shader.uniforms) program_.set(uniform.name, uniform.value);
  for (const appearance::TextureBinding& texture : shader.textures)
    add_texture(texture.sampler, *texture.texture);
  add_map("surface_normal_map", material.normal_map);
  add_map("surface_direction_map", material.direction_map);
  add_map("surface_occlusion_map", material.occlusion_map);
  program_.set("surface_normal_scale", material.normal_scale);
  program_.set("surface_material", index);
}

void SurfacePipeline::add_texture(const std::string& sampler, const TextureData& data) {
  program_.set(sampler, static_cast<int>(textures_.size()));
  textures_.emplace_back(data);
}

void SurfacePipeline::add_map(const std::string& name, const scene::SurfaceMap& map) {
  if (!map.texture) return;
  add_texture(name, *map.texture);
  program_.set(name + "_transform", Vec4f(map.scale.x(), map.scale.y(), map.offset.x(), map.offset.y()));
}

void SurfacePipeline::use(const scene::View& view, const Mat4& clip_from_view, bool counter_clockwise) const {
  program_.use();
  program_.set("view_from_object", Eigen::Matrix4f(view.view_from_object.cast<float>()));
  program_.set("clip_from_view", Eigen::Matrix4f(clip_from_view.cast<float>()));
  program_.set("perspective_view", view.perspective ? 1 : 0);
  program_.set("surface_front_sign", counter_clockwise ? 1.0f : -1.0f);
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) textures_[unit].bind(static_cast<int>(unit));
}

}  // namespace sateen::render
