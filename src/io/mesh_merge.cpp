// SPDX-License-Identifier: MIT
#include "sateen/io/mesh_merge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <assimp/scene.h>
#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/triangulate.h"

namespace sateen::io {
namespace {

Vec3f vector(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

bool finite(const aiVector3D& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Part {
  const aiMesh* mesh;
  aiMatrix4x4 transform;
};

std::vector<Part> parts_of(const aiScene& scene) {
  std::vector<Part> parts;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> stack = {{scene.mRootNode, aiMatrix4x4()}};
  while (!stack.empty()) {
    const auto [node, parent] = stack.back();
    stack.pop_back();
    const aiMatrix4x4 transform = parent * node->mTransformation;
    for (unsigned int i = 0; i < node->mNumMeshes; ++i) {
      parts.push_back({scene.mMeshes[node->mMeshes[i]], transform});
    }
    for (unsigned int i = node->mNumChildren; i-- > 0;) stack.emplace_back(node->mChildren[i], transform);
  }
  return parts;
}

bool has_triangles(const Part& part) {
  return std::any_of(part.mesh->mFaces, part.mesh->mFaces + part.mesh->mNumFaces,
                     [](const aiFace& face) { return face.mNumIndices >= 3; });
}

Eigen::Affine3d affine(const aiMatrix4x4& m) {
  Mat4 matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return Eigen::Affine3d(matrix);
}

struct Attributes {
  bool normals = true;
  bool tangents = true;
  bool uvs = false;
};

void append_vertices(Mesh& mesh, const aiMesh& part, const Eigen::Affine3d& transform,
                     const Attributes& attributes) {
  // The inverse transpose up to a positive factor: normals stay outward under a mirror, too.
  const Mat3 linear = transform.linear();
  const double determinant = linear.determinant();
  const Mat3 normal_matrix = determinant != 0 ? Mat3(linear.inverse().transpose()) : Mat3(Mat3::Identity());
  const float mirror = determinant < 0 ? -1.0f : 1.0f;
  const bool identity = transform.matrix().isIdentity(0);
  for (unsigned int i = 0; i < part.mNumVertices; ++i) {
    const Vec3f p = vector(part.mVertices[i]);
    mesh.positions.push_back(identity ? p : Vec3f((transform * p.cast<double>()).cast<float>()));
    if (attributes.normals) {
      const Vec3 n = normal_matrix * vector(part.mNormals[i]).cast<double>();
      mesh.normals.push_back(n.normalized().cast<float>());
    }
    if (attributes.tangents) {
      const Vec3f n = vector(part.mNormals[i]);
      const Vec3f t = vector(part.mTangents[i]);
      const float w = n.cross(t).dot(vector(part.mBitangents[i])) < 0 ? -mirror : mirror;
      const Vec3 turned = linear * t.cast<double>();
      mesh.tangents.emplace_back();
      mesh.tangents.back() << turned.cast<float>(), w;
    }
    if (attributes.uvs) {
      mesh.uvs.push_back(part.HasTextureCoords(0) ? Vec2f(vector(part.mTextureCoords[0][i]).head<2>())
                                                  : Vec2f(0, 0));
    }
  }
}

void append_triangles(Mesh& mesh, const aiMesh& part, std::uint32_t first, bool flip,
                      std::uint32_t material) {
  std::vector<Vec3f> corners;
  const auto append = [&](const aiFace& face, std::array<std::uint32_t, 3> places) {
    if (flip) std::swap(places[1], places[2]);
    mesh.triangles.push_back({first + face.mIndices[places[0]], first + face.mIndices[places[1]],
                              first + face.mIndices[places[2]]});
    mesh.material_ids.push_back(material);
  };
  for (unsigned int f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices == 3) {
      append(face, {0, 1, 2});
    } else if (face.mNumIndices > 3) {
      corners.clear();
      for (unsigned int c = 0; c < face.mNumIndices; ++c)
        corners.push_back(vector(part.mVertices[face.mIndices[c]]));
      for (const auto& places : triangulate(corners)) append(face, places);
    }
  }
}

}  // namespace

void check_scene(const aiScene& scene, const std::filesystem::path& path) {
  for (unsigned int m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const auto fail = [&](const std::string& what) {
      throw Error(fmt::format("{}: mesh {} '{}': {}", path.string(), m, mesh.mName.C_Str(), what));
    };
    for (unsigned int i = 0; i < mesh.mNumVertices; ++i) {
      if (!finite(mesh.mVertices[i])) fail(fmt::format("vertex {} has a position that is not finite", i));
      if (mesh.HasTextureCoords(0) && !finite(mesh.mTextureCoords[0][i])) {
        fail(fmt::format("vertex {} has texture coordinates that are not finite", i));
      }
    }
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned int c = 0; c < face.mNumIndices; ++c) {
        if (face.mIndices[c] >= mesh.mNumVertices) {
          fail(fmt::format("face {} uses vertex {}, there are {}", f, face.mIndices[c], mesh.mNumVertices));
        }
      }
    }
  }
}

MergedMesh merge_scene(const aiScene& scene) {
  MergedMesh result;
  Mesh& mesh = result.mesh;
  std::vector<Part> parts = parts_of(scene);
  std::erase_if(parts, [](const Part& part) { return !has_triangles(part); });
  Attributes attributes;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const Part& part : parts) {
    attributes.normals = attributes.normals && part.mesh->HasNormals();
    attributes.tangents =
        attributes.tangents && part.mesh->HasNormals() && part.mesh->HasTangentsAndBitangents();
    attributes.uvs = attributes.uvs || part.mesh->HasTextureCoords(0);
    vertices += part.mesh->mNumVertices;
    faces += part.mesh->mNumFaces;
  }
  if (vertices >= std::numeric_limits<std::uint32_t>::max())
    throw Error("a mesh with more than 4294967294 vertices cannot be read");
  mesh.positions.reserve(vertices);
  if (attributes.normals) mesh.normals.reserve(vertices);
  if (attributes.tangents) mesh.tangents.reserve(vertices);
  if (attributes.uvs) mesh.uvs.reserve(vertices);
  mesh.triangles.reserve(faces);
  mesh.material_ids.reserve(faces);
  for (const Part& part : parts) {
    const Eigen::Affine3d transform = affine(part.transform);
    const auto found = std::ranges::find(result.materials, part.mesh->mMaterialIndex);
    const auto material = static_cast<std::uint32_t>(found - result.materials.begin());
    if (found == result.materials.end()) result.materials.push_back(part.mesh->mMaterialIndex);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    append_vertices(mesh, *part.mesh, transform, attributes);
    append_triangles(mesh, *part.mesh, first, transform.linear().determinant() < 0, material);
  }
  return result;
}

}  // namespace sateen::io
