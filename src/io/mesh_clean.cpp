// SPDX-License-Identifier: MIT
#include "sateen/io/mesh_clean.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sateen/core/direction.h"
#include "sateen/core/first_equal.h"

namespace sateen::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Equal corners, or no area beyond rounding.
bool degenerate(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = (mesh.positions[t[1]] - mesh.positions[t[0]]).cast<double>();
  const Vec3 b = (mesh.positions[t[2]] - mesh.positions[t[0]]).cast<double>();
  return !(a.cross(b).norm() > 1e-14 * std::max(a.squaredNorm(), b.squaredNorm()));
}

void drop_degenerate(Mesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (degenerate(mesh, mesh.triangles[i])) continue;
    mesh.triangles[kept] = mesh.triangles[i];
    if (!mesh.material_ids.empty()) mesh.material_ids[kept] = mesh.material_ids[i];
    ++kept;
  }
  mesh.triangles.resize(kept);
  if (!mesh.material_ids.empty()) mesh.material_ids.resize(kept);
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

void clean_mesh(Mesh& mesh, bool join) {
  drop_degenerate(mesh);
  compact(mesh, join ? equal_vertices(mesh) : std::vector<std::uint32_t>());
  mend_normals(mesh);
  mend_tangents(mesh);
}

}  // namespace sateen::io
