// SPDX-License-Identifier: MIT
#include <fstream>

#include <gtest/gtest.h>

#include "sateen/geometry/tangents.h"
#include "sateen/io/mesh.h"
#include "support/files.h"

namespace sateen::io {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A flat n x n grid of squares with UVs, cut into triangles, as binary PLY; memory of one row.
void write_grid_ply(const std::filesystem::path& path, std::uint32_t n) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      (n + 1) * (n + 1), 2 * n * n);
  const float step = 1 / static_cast<float>(n);
  for (std::uint32_t j = 0; j <= n; ++j) {
    std::string row;
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float u = static_cast<float>(i) * step;
      const float v = static_cast<float>(j) * step;
      for (const float value : {u, v, 0.0f, u, v}) append(row, value);
    }
    file << row;
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    std::string row;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      const std::uint32_t c = a + n + 1;
      for (const auto& corners : {std::array{a, a + 1, c + 1}, std::array{a, c + 1, c}}) {
        row.push_back(3);
        for (const std::uint32_t corner : corners) append(row, corner);
      }
    }
    file << row;
  }
}

TEST(MeshSize, TenMillionTrianglesAreReadAndGetNormalsAndTangents) {
  constexpr std::uint32_t kSquares = 2237;
  const test::TemporaryFolder folder;
  write_grid_ply(folder / "big.ply", kSquares);
  Mesh mesh = read_model(folder / "big.ply").mesh;
  ASSERT_EQ(mesh.triangles.size(), 2u * kSquares * kSquares);
  ASSERT_GT(mesh.triangles.size(), 10'000'000u);
  geometry::compute_normals(mesh);
  geometry::compute_tangents(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 9973) {
    EXPECT_LT((mesh.normals[i] - Vec3f::UnitZ()).norm(), 1e-5f);
    EXPECT_LT((mesh.tangents[i] - Vec4f(1, 0, 0, 1)).norm(), 1e-3f);
  }
}

}  // namespace
}  // namespace sateen::io
