// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "sateen/io/mesh.h"

struct aiMaterial;
struct aiScene;

namespace sateen::io {

/// What Sateen carries over of an imported material: its name and, of glTF, normal and occlusion maps, looked
/// for in the scene and beside `path`. Maps on a second UV set are left out, and a rotated texture transform
/// loses its rotation. Throws Error when a picture is missing or corrupt.
MeshMaterial read_material(const aiScene& scene, const aiMaterial& material,
                           const std::filesystem::path& path);

/// A relative URI as a file name: %20 is a blank.
std::string decoded_uri(const std::string& uri);

}  // namespace sateen::io
