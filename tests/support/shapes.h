// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "sateen/core/mesh.h"

// Generated meshes with normals, tangents along u, and UVs.
namespace sateen::test {

/// Joins a grid of (columns + 1) x (rows + 1) vertices, row by row, into triangles that wind
/// counter-clockwise where u grows to the right and v upwards.
inline void join_grid(Mesh& mesh, int columns, int rows) {
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  mesh.material_names = {"default"};
}

/// Unit sphere around the origin; u runs around +y (eastwards), v from the south pole to the north pole. The
/// tangents are the parallels'.
inline Mesh sphere(int columns = 96, int rows = 48) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      const double v = static_cast<double>(j) / rows;
      const double phi = 2 * kPi * u;
      const double theta = kPi * v;
      const Vec3 n(std::sin(theta) * std::sin(phi), -std::cos(theta), std::sin(theta) * std::cos(phi));
      mesh.positions.push_back(n.cast<float>());
      mesh.normals.push_back(n.cast<float>());
      mesh.tangents.push_back(Vec3(std::cos(phi), 0, -std::sin(phi)).cast<float>().homogeneous());
      mesh.uvs.emplace_back(static_cast<float>(u), static_cast<float>(v));
    }
  }
  join_grid(mesh, columns, rows);
  return mesh;
}

/// Half a unit sphere, z >= 0, over a disc grid whose normals and tangents are exact at the vertices:
/// tangents lie in the plane turned by `angle` radians about +z, as on the sphere of a capture. No UVs.
inline Mesh captured_hemisphere(double angle, int rings = 64, int spokes = 192) {
  Mesh mesh;
  const Vec3 direction(std::cos(angle), std::sin(angle), 0);
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i <= spokes; ++i) {
      const double theta = kPi / 2 * (1 - static_cast<double>(j) / rings);
      const double phi = 2 * kPi * i / spokes;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      // The direction across the normal whose picture-plane angle is exactly `angle`: keep x and y, choose z.
      const double z = n.z() > 1e-9 ? -n.head<2>().dot(direction.head<2>()) / n.z() : 0;
      const Vec3 t = Vec3(direction.x(), direction.y(), z).normalized();
      mesh.positions.push_back(n.cast<float>());
      mesh.normals.push_back(n.cast<float>());
      mesh.tangents.push_back(t.cast<float>().homogeneous());
    }
  }
  join_grid(mesh, spokes, rings);
  return mesh;
}

/// A ring around +z; u runs around the ring, v around the tube. The tangents are along u, or along v
/// (`along_tube`).
inline Mesh torus(double tube = 0.4, int columns = 96, int rows = 48, bool along_tube = false) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double a = 2 * kPi * i / columns;
      const double b = 2 * kPi * j / rows;
      const Vec3 out(std::cos(a), std::sin(a), 0);
      const Vec3 n = std::cos(b) * out + std::sin(b) * Vec3::UnitZ();
      const Vec3 around(-std::sin(a), std::cos(a), 0);
      const Vec3 across = -std::sin(b) * out + std::cos(b) * Vec3::UnitZ();
      mesh.positions.push_back((out + tube * n).cast<float>());
      mesh.normals.push_back(n.cast<float>());
      mesh.tangents.push_back((along_tube ? across : around).cast<float>().homogeneous());
      mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(columns),
                            static_cast<float>(j) / static_cast<float>(rows));
    }
  }
  join_grid(mesh, columns, rows);
  return mesh;
}

/// The square x, y in [-1, 1] at z = 0, facing +z; u along x, v along y.
inline Mesh plane(int cells = 1) {
  Mesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(cells);
      const float v = static_cast<float>(j) / static_cast<float>(cells);
      mesh.positions.emplace_back(2 * u - 1, 2 * v - 1, 0);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.tangents.emplace_back(1, 0, 0, 1);
      mesh.uvs.emplace_back(u, v);
    }
  }
  join_grid(mesh, cells, cells);
  return mesh;
}

/// Every triangle in four, with attributes at the middles of edges interpolated, vectors made unit and
/// tangents orthogonal again. Vertices are not shared between the results.
inline Mesh subdivided(const Mesh& mesh) {
  Mesh result;
  result.material_names = mesh.material_names;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3f n = (mesh.normals[a] + mesh.normals[b]).normalized();
    const Vec3f t = (mesh.tangents[a] + mesh.tangents[b]).head<3>();
    result.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
    result.normals.push_back(n);
    result.tangents.emplace_back(0, 0, 0, mesh.tangents[a].w());
    result.tangents.back().head<3>() = (t - n * n.dot(t)).normalized();
    result.uvs.push_back((mesh.uvs[a] + mesh.uvs[b]) / 2);
    return static_cast<std::uint32_t>(result.positions.size() - 1);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t corner_a = add(a, a);
    const std::uint32_t corner_b = add(b, b);
    const std::uint32_t corner_c = add(c, c);
    const std::uint32_t ab = add(a, b);
    const std::uint32_t bc = add(b, c);
    const std::uint32_t ca = add(c, a);
    for (const auto& triangle : {std::array{corner_a, ab, ca}, std::array{ab, corner_b, bc},
                                 std::array{ca, bc, corner_c}, std::array{ab, bc, ca}}) {
      result.triangles.push_back(triangle);
    }
  }
  return result;
}

}  // namespace sateen::test
