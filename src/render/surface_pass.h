// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sateen/gpu/cache.h"
#include "sateen/render/surface_program.h"
#include "sateen/scene/camera.h"

namespace sateen::render {

/// What all passes of a renderer share.
struct Caches {
  gpu::TextureCache textures;
  gpu::ProgramCache programs;
};

/// The pose and light that a frame is drawn with.
struct FrameState {
  const scene::View& view;
  const Mat4& clip_from_view;
  bool counter_clockwise;  ///< how front faces wind
  double tangent_turn;     ///< radians
  const light::Lighting& lighting;
};

/// The surface pass for one material, with its values at one revision of its appearance.
class SurfacePass {
 public:
  /// Throws Error when the appearance's shader does not compile.
  SurfacePass(const scene::Material& material, int index, const scene::RenderSwitches& switches,
              SurfaceProgram::Output output, Caches& caches);

  /// Takes up what the appearance has become; another program only where its module differs.
  void update(Caches& caches);

  /// Puts program, uniforms and textures in place for drawing.
  void use(const FrameState& frame, Caches& caches) const;
  /// Of the packed surface, which targets are written next.
  void set_first_target(int target) const;

 private:
  void compile(Caches& caches);
  void add_texture(const std::string& sampler, const std::shared_ptr<const TextureData>& data,
                   Caches& caches);
  void add_map(const std::string& name, const scene::SurfaceMap& map, Caches& caches);
  void set_lighting(const light::Lighting& lighting) const;

  struct Bound {
    std::string sampler;
    std::shared_ptr<const gpu::Texture> texture;
  };
  scene::Material material_;
  int index_;
  scene::RenderSwitches switches_;
  SurfaceProgram::Output output_;
  std::uint64_t revision_ = 0;
  appearance::ShaderModule module_;
  std::shared_ptr<const gpu::Program> program_;
  std::vector<appearance::UniformBinding> uniforms_;
  std::vector<Bound> textures_;  ///< by texture unit
};

}  // namespace sateen::render
