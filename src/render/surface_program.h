// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sateen/gpu/program.h"
#include "sateen/scene/scene.h"

namespace sateen::render {

/// The texts of the surface pass (shaders/surface/) for one material: its shader module, the loop over lamps
/// if it is lit, and the switches as definitions. Owns what the program's texts refer to.
struct SurfaceProgram {
  appearance::ShaderModule module;
  gpu::ProgramText text;

  /// What the pass writes.
  enum class Output {
    color,
    surface,  ///< four targets of the packed surface, without the appearance but for its holes
  };
  SurfaceProgram(const scene::Material& material, const scene::RenderSwitches& switches, Output output);
  SurfaceProgram(const SurfaceProgram&) = delete;
  SurfaceProgram& operator=(const SurfaceProgram&) = delete;
};

/// Names of the vertex attributes by location: those of surface.vert, then the surface fields that vertices
/// carry.
const std::vector<std::string>& vertex_attributes();

}  // namespace sateen::render
