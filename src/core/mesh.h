// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sateen/core/vector.h"

namespace sateen {

/// A triangle mesh. Every per-vertex array is either empty (the mesh has no such attribute) or as long as
/// `positions`; a vertex with several normals or UVs is split.
struct Mesh {
  std::vector<Vec3f> positions;  ///< object space
  std::vector<Vec3f> normals;    ///< unit, outward
  std::vector<Vec4f>
      tangents;  ///< xyz unit, along increasing u; w = +1 or -1, bitangent = w * cross(normal, tangent)
  std::vector<Vec2f> uvs;        ///< v runs up, whatever the file's convention
  std::vector<float> occlusion;  ///< ambient occlusion in [0, 1]; 1 is open
  std::vector<float> curvature;  ///< mean curvature, 1 / length unit of the mesh, positive where convex
  /// The second fundamental form as a symmetric matrix in object space: {xx, yy, zz} and {yz, xz, xy}. Along
  /// a unit tangent t the surface bends by t.M t, in 1 / length unit, positive where convex.
  std::vector<std::array<Vec3f, 2>> curvature_forms;

  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::uint32_t> material_ids;  ///< per triangle, index into material_names; empty: all 0
  std::vector<std::string> material_names;
};

/// Throws Error unless all that is said of the arrays' lengths and indices above is true.
void check(const Mesh& mesh);

}  // namespace sateen
