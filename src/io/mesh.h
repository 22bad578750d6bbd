// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sateen/core/image.h"
#include "sateen/core/mesh.h"

namespace sateen::io {

/// What a mesh file says of one of its materials, as far as Sateen carries it over. Pictures are empty where
/// there are none; their texture coordinates are uv_scale * uv + uv_offset, v up.
struct MeshMaterial {
  std::string name;
  Image normal_map;     ///< tangent space, data in [0, 1], green up
  Image occlusion_map;  ///< data in [0, 1], first channel
  Vec2f normal_uv_scale{1, 1};
  Vec2f normal_uv_offset{0, 0};
  Vec2f occlusion_uv_scale{1, 1};
  Vec2f occlusion_uv_offset{0, 0};
};

struct Model {
  Mesh mesh;                            ///< all meshes of the file, node transforms applied, in one
  std::vector<MeshMaterial> materials;  ///< as many as mesh.material_names
};

/// Extensions of the mesh files that can be read, lower case with the dot.
std::span<const std::string> mesh_extensions();

/// Reads OBJ, PLY, GLB or glTF. Polygons become triangles; triangles with equal indices or without area are
/// dropped; unit tangents are kept when the file has them; normals and tangents that are missing are left
/// empty. Throws Error naming the file when it is missing, no mesh, truncated, has no triangles or positions
/// that are not finite.
Model read_model(const std::filesystem::path& path);

}  // namespace sateen::io
