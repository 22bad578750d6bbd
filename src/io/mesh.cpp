// SPDX-License-Identifier: MIT
#include "sateen/io/mesh.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/gltf_check.h"
#include "sateen/io/mesh_clean.h"
#include "sateen/io/mesh_material.h"
#include "sateen/io/mesh_merge.h"
#include "sateen/io/ply.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;

Model read_ply_model(const fs::path& path) {
  Model model;
  model.mesh = read_ply(path);
  for (std::size_t i = 0; i < model.mesh.positions.size(); ++i) {
    if (!model.mesh.positions[i].allFinite())
      fail(path, fmt::format("vertex {} has a position that is not finite", i));
  }
  for (std::size_t i = 0; i < model.mesh.uvs.size(); ++i) {
    if (!model.mesh.uvs[i].allFinite()) {
      fail(path, fmt::format("vertex {} has texture coordinates that are not finite", i));
    }
  }
  clean_mesh(model.mesh, false);
  model.materials.emplace_back().name = "default";
  model.mesh.material_names = {"default"};
  return model;
}

// No post-processing: assimp's steps trust the indices of the file, and its joining of vertices takes minutes
// and gigabytes on millions of triangles. It gives every corner of an OBJ file a vertex of its own, which is
// why those are joined here.
Model read_with_assimp(const fs::path& path, const char* extension, bool join) {
  Assimp::Importer importer;
  // Of its dozens of readers the one that is meant; none that takes the file for something else.
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string known = importer.GetImporterInfo(i)->mFileExtensions;
    if (known.find(extension) != std::string::npos) continue;
    const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
    importer.UnregisterLoader(other.get());
  }
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) fail(path, fmt::format("cannot be read as a mesh: {}", importer.GetErrorString()));
  if (scene->mRootNode == nullptr) fail(path, "has no triangles");
  check_scene(*scene, path);
  MergedMesh merged = merge_scene(*scene);
  Model model;
  model.mesh = std::move(merged.mesh);
  clean_mesh(model.mesh, join);
  for (const unsigned int index : merged.materials) {
    model.materials.push_back(index < scene->mNumMaterials
                                  ? read_material(*scene, *scene->mMaterials[index], path)
                                  : MeshMaterial());
    model.mesh.material_names.push_back(model.materials.back().name);
  }
  return model;
}

Model read_obj(const fs::path& path) {
  return read_with_assimp(path, "obj", true);
}

Model read_gltf(const fs::path& path) {
  check_gltf(path);
  return read_with_assimp(path, "gltf", false);
}

struct MeshFormat {
  std::string_view extension;  ///< lower case with the dot
  Model (*read)(const fs::path&);
};

/// One line a format.
constexpr std::array<MeshFormat, 4> kMeshFormats{{
    {".obj", read_obj},
    {".ply", read_ply_model},
    {".glb", read_gltf},
    {".gltf", read_gltf},
}};

}  // namespace

std::span<const std::string> mesh_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> result;
    for (const MeshFormat& format : kMeshFormats) result.emplace_back(format.extension);
    return result;
  }();
  return extensions;
}

Model read_model(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) fail(path, "no such file");
  if (fs::is_directory(path, code)) fail(path, "is a folder, a mesh file is needed");
  if (!fs::is_regular_file(path, code)) fail(path, "is no regular file, a mesh file is needed");
  const auto format = std::ranges::find(kMeshFormats, extension_of(path), &MeshFormat::extension);
  if (format == kMeshFormats.end()) {
    fail(path,
         fmt::format("is not a mesh that can be read; known are {}", fmt::join(mesh_extensions(), ", ")));
  }
  Model model = format->read(path);
  if (model.mesh.triangles.empty()) fail(path, "has no triangles");
  try {
    check(model.mesh);
  } catch (const Error& error) {
    fail(path, error.what());
  }
  return model;
}

}  // namespace sateen::io
