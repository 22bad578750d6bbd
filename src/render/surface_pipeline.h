// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "sateen/gpu/program.h"
#include "sateen/gpu/texture.h"
#include "sateen/scene/camera.h"
#include "sateen/scene/scene.h"

namespace sateen::render {

/// The surface pipeline (shaders/surface.vert, surface.frag) compiled for one material and one set of
/// switches, with the textures it reads.
class SurfacePipeline {
 public:
  /// `write_surface` makes the variant that also writes targets 1 to 5 (frame.h, SurfaceImages).
  /// Throws Error when the appearance's shader does not compile.
  SurfacePipeline(const scene::Material& material, int index, const scene::RenderSwitches& switches,
                  bool write_surface);

  /// Puts program, uniforms and textures in place for drawing.
  void use(const scene::View& view, const Mat4& clip_from_view, bool counter_clockwise) const;

 private:
  void add_texture(const std::string& sampler, const TextureData& data);
  void add_map(const std::string& name, const scene::SurfaceMap& map);

  gpu::Program program_;
  std::vector<gpu::Texture> textures_;  ///< by texture unit
};

}  // namespace sateen::render
