// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "sateen/core/mesh.h"

struct aiScene;

namespace sateen::io {

struct MergedMesh {
  Mesh mesh;                            ///< material_names still empty
  std::vector<unsigned int> materials;  ///< index in the scene of each material that triangles use
};

/// Throws Error naming `path` and the mesh when an index points outside it or a number is not finite.
void check_scene(const aiScene& scene, const std::filesystem::path& path);

/// The faces of a checked scene as triangles in one mesh, node transforms applied; lines and points are left
/// out. Normals and tangents are kept when every part has them; UVs when any part has them (the others get
/// 0).
MergedMesh merge_scene(const aiScene& scene);

}  // namespace sateen::io
