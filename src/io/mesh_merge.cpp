// SPDX-License-Identifier: MIT
#include "sateen/io/mesh_merge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <assimp/scene.h>
#include <fmt/format.h>

#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/core/first_equal.h"

namespace sateen {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

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
                     [](const aiFace& face) { return face.mNumIndices == 3; });
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

// Equal corners, or no area beyond rounding.
bool degenerate(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = (mesh.positions[t[1]] - mesh.positions[t[0]]).cast<double>();
  const Vec3 b = (mesh.positions[t[2]] - mesh.positions[t[0]]).cast<double>();
  return !(a.cross(b).norm() > 1e-14 * std::max(a.squaredNorm(), b.squaredNorm()));
}

void append_triangles(Mesh& mesh, const aiMesh& part, std::uint32_t first, bool flip,
                      std::uint32_t material) {
  for (unsigned int f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    std::array<std::uint32_t, 3> triangle = {first + face.mIndices[0], first + face.mIndices[1],
                                             first + face.mIndices[2]};
    if (flip) std::swap(triangle[1], triangle[2]);
    if (degenerate(mesh, triangle)) continue;
    mesh.triangles.push_back(triangle);
    mesh.material_ids.push_back(material);
  }
}

// Replaces every vertex by representative[vertex] and drops the vertices that no triangle uses.
void compact(Mesh& mesh, const std::vector<std::uint32_t>& representative) {
  std::vector<std::uint32_t> place(mesh.positions.size(), kNone);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      if (!representative.empty()) vertex = representative[vertex];
      place[vertex] = 0;
    }
  }
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    if (place[i] == kNone) continue;
    const auto move = [&](auto& values) {
      if (!values.empty()) values[kept] = values[i];
    };
    move(mesh.positions);
    move(mesh.normals);
    move(mesh.tangents);
    move(mesh.uvs);
    place[i] = kept++;
  }
  if (kept == place.size()) return;
  const auto cut = [&](auto& values) {
    if (values.empty()) return;
    values.resize(kept);
    values.shrink_to_fit();
  };
  cut(mesh.positions);
  cut(mesh.normals);
  cut(mesh.tangents);
  cut(mesh.uvs);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = place[vertex];
  }
}

std::vector<std::uint32_t> equal_vertices(const Mesh& mesh) {
  const auto hash = [&](std::uint32_t i) {
    std::uint64_t h = 0;
    for (const float x : mesh.positions[i]) h = mix_hash(h, hash_bits(x));
    if (!mesh.normals.empty()) {
      for (const float x : mesh.normals[i]) h = mix_hash(h, hash_bits(x));
    }
    if (!mesh.uvs.empty()) {
      for (const float x : mesh.uvs[i]) h = mix_hash(h, hash_bits(x));
    }
    return h;
  };
  const auto equal = [&](std::uint32_t i, std::uint32_t j) {
    return mesh.positions[i] == mesh.positions[j] &&
           (mesh.normals.empty() || mesh.normals[i] == mesh.normals[j]) &&
           (mesh.uvs.empty() || mesh.uvs[i] == mesh.uvs[j]);
  };
  return first_equal(static_cast<std::uint32_t>(mesh.positions.size()), hash, equal);
}

// Gives the vertices whose normal the file left zero or not finite the normal of their triangles.
void mend_normals(Mesh& mesh) {
  const auto bad = [](const Vec3f& n) { return !(std::abs(n.norm() - 1) < 1e-3f); };
  if (std::ranges::none_of(mesh.normals, bad)) return;
  std::vector<Vec3f> sums(mesh.normals.size(), Vec3f::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Vec3f cross = a.cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (const std::uint32_t vertex : t) sums[vertex] += cross;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (bad(mesh.normals[i])) mesh.normals[i] = sums[i].norm() > 0 ? sums[i].normalized() : Vec3f::UnitZ();
  }
}

// Makes tangents unit and orthogonal to the normals; those the file left without a direction take their
// neighbours'.
void mend_tangents(Mesh& mesh) {
  const auto set = [&](std::size_t vertex, const Vec3& direction) {
    const Vec3 n = mesh.normals[vertex].cast<double>();
    const Vec3 unit = direction.normalized();
    const Vec3 across = unit - n.dot(unit) * n;
    if (!(across.norm() > 1e-3)) return false;
    mesh.tangents[vertex].head<3>() = across.normalized().cast<float>();
    return true;
  };
  std::vector<char> good(mesh.tangents.size());
  for (std::size_t i = 0; i < good.size(); ++i)
    good[i] = set(i, mesh.tangents[i].head<3>().cast<double>()) ? 1 : 0;
  if (std::ranges::all_of(good, [](char g) { return g != 0; })) return;
  std::vector<Vec3> sums(good.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (const std::uint32_t other : {t[(c + 1) % 3], t[(c + 2) % 3]}) {
        if (!good[t[c]] && good[other]) sums[t[c]] += mesh.tangents[other].head<3>().cast<double>();
      }
    }
  }
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (good[i] || set(i, sums[i])) continue;
    Vec3 tangent;
    Vec3 bitangent;
    frame_around(mesh.normals[i].cast<double>(), tangent, bitangent);
    mesh.tangents[i].head<3>() = tangent.cast<float>();
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

MergedMesh merge_scene(const aiScene& scene, bool join) {
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
  if (vertices >= kNone) throw Error("a mesh with more than 4294967294 vertices cannot be read");
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
  compact(mesh, join ? equal_vertices(mesh) : std::vector<std::uint32_t>());
  mend_normals(mesh);
  mend_tangents(mesh);
  return result;
}

}  // namespace sateen
