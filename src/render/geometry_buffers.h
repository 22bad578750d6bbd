// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sateen/gpu/handle.h"
#include "sateen/scene/scene.h"

namespace sateen::render {

/// A mesh on the GPU, its triangles sorted by material. Attributes have the locations of vertex_attributes()
/// (surface_program.h).
class GeometryBuffers {
 public:
  explicit GeometryBuffers(const scene::Scene& scene);

  /// Whether a material has no triangles.
  bool empty(std::size_t material) const { return first_index_[material] == first_index_[material + 1]; }

  /// Draws the triangles of one material with the program in use.
  void draw(std::size_t material) const;

  /// Whether front faces wind counter-clockwise. Told from the normals, because files disagree.
  bool counter_clockwise() const { return counter_clockwise_; }

 private:
  gpu::Handle vertex_array_;
  std::vector<gpu::Handle> buffers_;
  std::vector<std::size_t> first_index_;  ///< per material, and the end
  bool counter_clockwise_ = true;
};

}  // namespace sateen::render
