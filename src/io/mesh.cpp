// SPDX-License-Identifier: MIT
#include "sateen/io/mesh.h"

#include <algorithm>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/mesh_header.h"
#include "sateen/io/mesh_material.h"
#include "sateen/io/mesh_merge.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

void check_file(const fs::path& path, const std::string& extension) {
  const auto fail = [&](const char* what) { throw Error(fmt::format("{}: {}", path.string(), what)); };
  std::error_code code;
  if (!fs::exists(path, code)) fail("no such file");
  if (fs::is_directory(path, code)) fail("is a folder, a mesh file is needed");
  if (extension == ".ply") {
    check_ply(path);
  } else if (extension == ".glb" || extension == ".gltf") {
    check_gltf(path);
  } else if (extension != ".obj") {
    fail("is not a mesh that can be read; OBJ, PLY, GLB or glTF is needed");
  }
}

bool has_polygons(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes, [](const aiMesh* mesh) {
    return std::any_of(mesh->mFaces, mesh->mFaces + mesh->mNumFaces,
                       [](const aiFace& face) { return face.mNumIndices > 3; });
  });
}

}  // namespace

Model read_model(const fs::path& path) {
  const std::string extension = extension_of(path);
  check_file(path, extension);
  const auto fail = [&](const std::string& what) { throw Error(fmt::format("{}: {}", path.string(), what)); };

  // No post-processing but triangulation, and that only after our own check of the indices: assimp's steps
  // trust them, and its joining of vertices takes minutes and gigabytes on millions of triangles.
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) fail(fmt::format("cannot be read as a mesh: {}", importer.GetErrorString()));
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) fail("has no triangles");
  check_scene(*scene, path);
  if (has_polygons(*scene)) {
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr) fail(fmt::format("cannot be triangulated: {}", importer.GetErrorString()));
  }

  // assimp gives every corner of an OBJ file a vertex of its own.
  MergedMesh merged = merge_scene(*scene, extension == ".obj");
  if (merged.mesh.triangles.empty()) fail("has no triangles");
  Model model;
  model.mesh = std::move(merged.mesh);
  for (const unsigned int index : merged.materials) {
    model.materials.push_back(index < scene->mNumMaterials
                                  ? read_material(*scene, *scene->mMaterials[index], path)
                                  : MeshMaterial());
    model.mesh.material_names.push_back(model.materials.back().name);
  }
  return model;
}

}  // namespace sateen
