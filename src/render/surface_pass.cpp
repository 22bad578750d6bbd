// SPDX-License-Identifier: MIT
#include "sateen/render/surface_pass.h"

#include <algorithm>
#include <cmath>

namespace sateen::render {
namespace {

/// A black texel, for a sampler that must have something.
const std::shared_ptr<const TextureData>& nothing() {
  static const std::shared_ptr<const TextureData> texel = [] {
    auto texture = std::make_shared<TextureData>();
    texture->format = TextureData::Format::rgba8;
    texture->width = texture->height = 1;
    texture->levels = {std::vector<std::byte>(4)};
    return texture;
  }();
  return texel;
}

}  // namespace

SurfacePass::SurfacePass(const scene::Material& material, int index, const scene::RenderSwitches& switches,
                         SurfaceProgram::Output output, Caches& caches)
    : material_(material), index_(index), switches_(switches), output_(output) {
  compile(caches);
  update(caches);
}

void SurfacePass::compile(Caches& caches) {
  const SurfaceProgram made(material_, switches_, output_);
  module_ = made.module;
  program_ = caches.programs.of(made.text);
}

void SurfacePass::update(Caches& caches) {
  appearance::Appearance& appearance = *material_.appearance;
  if (revision_ == appearance.revision()) return;
  if (!(appearance.shader() == module_)) compile(caches);
  uniforms_.clear();
  textures_.clear();
  if (output_ == SurfaceProgram::Output::color || module_.covers) {
    appearance::ShaderValues values = appearance.values();
    uniforms_ = std::move(values.uniforms);
    for (const auto& [sampler, texture] : values.textures) add_texture(sampler, texture, caches);
  }
  add_map("surface_normal_map", material_.normal_map, caches);
  add_map("surface_direction_map", material_.direction_map, caches);
  add_map("surface_occlusion_map", material_.occlusion_map, caches);
  uniforms_.push_back({"surface_normal_scale", material_.normal_scale});
  uniforms_.push_back({"surface_material", index_});
  revision_ = appearance.revision();
}

void SurfacePass::add_texture(const std::string& sampler, const std::shared_ptr<const TextureData>& data,
                              Caches& caches) {
  textures_.push_back({sampler, caches.textures.of(data)});
}

void SurfacePass::add_map(const std::string& name, const scene::SurfaceMap& map, Caches& caches) {
  if (!map.texture) return;
  add_texture(name, map.texture, caches);
  uniforms_.push_back(
      {name + "_transform", Vec4f(map.scale.x(), map.scale.y(), map.offset.x(), map.offset.y())});
}

void SurfacePass::set_lighting(const light::Lighting& lighting) const {
  using light::PunctualLight;
  std::vector<Vec4f> positions;
  std::vector<Vec4f> colours;
  std::vector<Vec4f> axes;
  for (const PunctualLight& lamp : lighting.lamps) {
    const bool directional = lamp.kind == PunctualLight::Kind::directional;
    const bool spot = lamp.kind == PunctualLight::Kind::spot;
    const Vec3f at = (directional ? lamp.direction : lamp.position).cast<float>();
    const Vec3f colour = lamp.colour.cast<float>();
    const Vec3f axis = lamp.direction.cast<float>();
    const double outer = std::cos(lamp.outer_cone);
    positions.emplace_back(at.x(), at.y(), at.z(), directional ? 0.0f : 1.0f);
    colours.emplace_back(
        colour.x(), colour.y(), colour.z(),
        spot ? static_cast<float>(1 / std::max(std::cos(lamp.inner_cone) - outer, 1e-4)) : 0.0f);
    axes.emplace_back(axis.x(), axis.y(), axis.z(), static_cast<float>(outer));
  }
  program_->set("light_count", static_cast<int>(positions.size()));
  program_->set("light_position", positions);
  program_->set("light_colour", colours);
  program_->set("light_axis", axes);

  const light::Surroundings& surroundings = lighting.surroundings;
  std::vector<Vec3f> harmonics;
  for (const Vec3& c : surroundings.harmonics.c) harmonics.push_back(c.cast<float>());
  program_->set("environment_harmonics", harmonics);
  program_->set("environment_present", surroundings.environment ? 1 : 0);
  program_->set("environment_from_view", Eigen::Matrix3f(surroundings.environment_from_view.cast<float>()));
  program_->set("environment_last_level",
                static_cast<float>(surroundings.environment ? surroundings.environment->levels() - 1 : 0));
}

void SurfacePass::use(const FrameState& frame, Caches& caches) const {
  // Making a texture binds it: before those that are to be read.
  std::shared_ptr<const gpu::Texture> environment_map;
  const bool lit = output_ == SurfaceProgram::Output::color && !module_.point.empty();
  if (lit) {
    const auto& environment = frame.lighting.surroundings.environment;
    environment_map = caches.textures.of(environment ? environment->texture() : nothing());
  }
  program_->use();
  program_->set("view_from_object", Eigen::Matrix4f(frame.view.view_from_object.cast<float>()));
  program_->set("clip_from_view", Eigen::Matrix4f(frame.clip_from_view.cast<float>()));
  program_->set("perspective_view", frame.view.perspective ? 1 : 0);
  program_->set("surface_front_sign", frame.counter_clockwise ? 1.0f : -1.0f);
  program_->set("tangent_turn",
                Vec2f(Vec2(std::cos(frame.tangent_turn), std::sin(frame.tangent_turn)).cast<float>()));
  for (const appearance::UniformBinding& uniform : uniforms_) {
    if (uniform.optional && !program_->declares(uniform.name)) continue;
    program_->set(uniform.name, uniform.value);
  }
  int unit = 0;
  for (const Bound& bound : textures_) {
    program_->set(bound.sampler, unit);
    bound.texture->bind(unit++);
  }
  if (!lit) return;
  set_lighting(frame.lighting);
  program_->set("environment_map", unit);
  environment_map->bind(unit);
}

void SurfacePass::set_first_target(int target) const {
  program_->set("surface_first_target", target);
}

}  // namespace sateen::render
