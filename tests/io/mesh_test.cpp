// SPDX-License-Identifier: MIT
#include "sateen/io/mesh.h"

#include <cstring>
#include <fstream>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/image.h"
#include "support/files.h"
#include "support/gltf.h"
#include "support/meshes.h"

namespace sateen::io {
namespace {

using namespace test;
using testing::HasSubstr;

std::string error_of(const std::filesystem::path& path) {
  try {
    read_model(path);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.filename().string()));
    return error.what();
  }
  return "no error";
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[1]] - mesh.positions[t[0]];
    area += static_cast<double>(a.cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm()) / 2;
  }
  return area;
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST(MeshFile, ObjKeepsUvsUpAndJoinsCornersButNotSeams) {
  const TemporaryFolder folder;
  test::put_text(
      folder / "a.obj",
      fmt::format("{}usemtl red\nf 1/1 2/2 3/3\nusemtl blue cloth\nf -4/-4 -2/-2 -1/-1\n", kSquare));
  const Model model = read_model(folder / "a.obj");
  EXPECT_EQ(model.mesh.positions.size(), 4u);
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_TRUE(model.mesh.normals.empty());
  EXPECT_TRUE(model.mesh.tangents.empty());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(model.mesh.uvs[i], model.mesh.positions[i].head<2>());
  EXPECT_EQ(model.mesh.material_names, (std::vector<std::string>{"red", "blue cloth"}));
  EXPECT_EQ(model.mesh.material_ids, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(model.materials.size(), 2u);

  test::put_text(folder / "seam.obj", fmt::format("{}vt 5 5\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n", kSquare));
  EXPECT_EQ(read_model(folder / "seam.obj").mesh.positions.size(), 5u);
}

TEST(MeshFile, TheExampleGarmentIsWhole) {
  const Model model = read_model(examples() / "garment" / "jacket.obj");
  EXPECT_EQ(model.mesh.triangles.size(), 2u * 6165u);
  EXPECT_EQ(model.mesh.uvs.size(), 6816u);  // distinct corners: awk and sort -u say so
  for (const Vec2f& uv : model.mesh.uvs) EXPECT_TRUE(uv.minCoeff() >= 0 && uv.maxCoeff() <= 1);
}

TEST(MeshFile, PolygonsBecomeTrianglesConcaveOnesToo) {
  const TemporaryFolder folder;
  test::put_text(folder / "quad.obj", fmt::format("{}f 1 2 3 4\n", kSquare));
  const Mesh quad = read_model(folder / "quad.obj").mesh;
  EXPECT_EQ(quad.triangles.size(), 2u);
  EXPECT_NEAR(area_of(quad), 1, 1e-6);
  // An L of six corners, area 3, starting where a fan of triangles would leave it.
  test::put_text(folder / "l.obj", "v 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4 5 6\n");
  const Mesh polygon = read_model(folder / "l.obj").mesh;
  EXPECT_EQ(polygon.triangles.size(), 4u);
  EXPECT_NEAR(area_of(polygon), 3, 1e-6);
}

TEST(MeshFile, DegenerateTrianglesAndUnusedVerticesAreDropped) {
  const TemporaryFolder folder;
  test::put_text(
      folder / "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "9 9 9\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n0 0 0\n"
      "3 1 2 3\n3 1 1 2\n3 1 2 4\n3 1 5 3\n");
  const Mesh mesh = read_model(folder / "a.ply").mesh;
  EXPECT_EQ(mesh.positions.size(), 3u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST(MeshFile, APlyWithTwoListsOfVerticesIsRefused) {
  const TemporaryFolder folder;
  test::put_text(
      folder / "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n");
  EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("two lists of vertices"));
}

TEST(MeshFile, PlyInAllEncodingsWithNormalsAndUvs) {
  const TemporaryFolder folder;
  const std::string header =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty "
      "float ny\n"
      "property float nz\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int "
      "vertex_indices\n"
      "end_header\n";
  const float numbers[3][8] = {{0, 0, 0, 0, 0, 2, 0, 0}, {1, 0, 0, 0, 0, 2, 1, 0}, {0, 1, 0, 0, 0, 2, 0, 1}};
  for (const bool big : {false, true}) {
    std::string bytes = fmt::format("ply\nformat binary_{}_endian 1.0\n{}", big ? "big" : "little", header);
    const auto put = [&](const auto& value) {
      std::string raw(sizeof(value), '\0');
      std::memcpy(raw.data(), &value, sizeof(value));
      if (big) std::reverse(raw.begin(), raw.end());
      bytes += raw;
    };
    for (const auto& row : numbers) {
      for (const float x : row) put(x);
    }
    bytes += '\3';
    for (const int i : {0, 1, 2}) put(i);
    const auto path = folder / (big ? "big.ply" : "little.ply");
    test::put_text(path, bytes);
    const Mesh mesh = read_model(path).mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[1], Vec3f(1, 0, 0));
    EXPECT_EQ(mesh.normals[1], Vec3f(0, 0, 1));  // unit whatever the file says
    EXPECT_EQ(mesh.uvs[2], Vec2f(0, 1));

    for (const std::size_t cut :
         {std::size_t{1}, std::size_t{5}, std::size_t{13}, std::size_t{40}, bytes.size() - 20}) {
      test::put_text(folder / "cut.ply", bytes.substr(0, bytes.size() - cut));
      EXPECT_THAT(error_of(folder / "cut.ply"), Not(HasSubstr("no error"))) << cut;
    }
  }
}

TEST(MeshFile, ATruncatedTextPlyIsAnErrorAtAnyLength) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\r\nformat ascii 1.0\r\ncomment a quad and a strip of three\r\nelement vertex 5\r\nproperty double "
      "x\r\n"
      "property double y\r\nproperty double z\r\nproperty uchar red\r\nelement face 1\r\n"
      "property list uchar uint vertex_index\r\nproperty list uchar float texcoord\r\nelement tristrips 1\r\n"
      "property list int int vertex_indices\r\nend_header\r\n";
  const std::string body =
      "0 0 0 255\r\n1 0 0 0\r\n1 1 0 0\r\n0 1 0 0\r\n+2 0 0 7\r\n4 0 1 2 3 2 0.5 0.5\r\n6 1 4 2 -1 0 1";
  test::put_text(folder / "a.ply", header + body);
  const Mesh mesh = read_model(folder / "a.ply").mesh;
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_EQ(mesh.positions[4], Vec3f(2, 0, 0));
  for (std::size_t length = 0; length + 1 < header.size() + body.size(); length += 3) {
    test::put_text(folder / "cut.ply", (header + body).substr(0, length));
    EXPECT_NE(error_of(folder / "cut.ply"), "no error") << length;
  }
}

// Unsigned means unsigned: places above the half of what the type holds.
TEST(MeshFile, PlyIndicesMayFillTheirType) {
  const TemporaryFolder folder;
  for (const auto& [type, bytes, count] : {std::tuple{"uchar", 1, 256u}, std::tuple{"ushort", 2, 40000u}}) {
    std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
        "y\nproperty float "
        "z\nelement face 1\nproperty list uchar {} vertex_indices\nend_header\n",
        count, type);
    const auto put = [&](const void* value, std::size_t size) {
      text.append(static_cast<const char*>(value), size);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const float position[3] = {static_cast<float>(i), static_cast<float>(i % 7), 0};
      put(position, sizeof(position));
    }
    text += '\3';
    for (const std::uint32_t index : {0u, count - 2, count - 1}) put(&index, static_cast<std::size_t>(bytes));
    write_text(folder / "a.ply", text);
    const Mesh mesh = read_model(folder / "a.ply").mesh;
    ASSERT_EQ(mesh.positions.size(), 3u) << type;
    EXPECT_EQ(mesh.positions[2].x(), static_cast<float>(count - 1)) << type;
  }
}

TEST(MeshFile, AttributesStayWithTheirVerticesAndMaterialsWithTheirTriangles) {
  const TemporaryFolder folder;
  // The first vertex is used by no triangle.
  write_text(folder / "a.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
             "9 9 9 1 0 0 9 9\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n3 1 2 3\n");
  const Mesh mesh = read_model(folder / "a.ply").mesh;
  ASSERT_EQ(mesh.uvs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.uvs[i], mesh.positions[i].head<2>());
    EXPECT_EQ(mesh.normals[i], Vec3f::UnitZ());
  }
  // Of red's two triangles the first has no area.
  write_text(folder / "a.obj",
             fmt::format("{}v 2 0 0\nusemtl red\nf 1 2 5\nf 1 2 3\nusemtl blue\nf 1 3 4\n", kSquare));
  EXPECT_EQ(read_model(folder / "a.obj").mesh.material_ids, (std::vector<std::uint32_t>{0, 1}));
}

TEST(MeshFile, NormalsWithoutDirectionAreThoseOfTheTriangles) {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", fmt::format("{}vn 0 0 0\nf 1//1 2//1 3//1\n", kSquare));
  for (const Vec3f& n : read_model(folder / "a.obj").mesh.normals) EXPECT_EQ(n, Vec3f::UnitZ());
}

TEST(MeshFile, PlyFacesWindAsTheFileSaysStripsToo) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  test::put_text(folder / "a.ply", header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 0 1 2 3 4\n");
  const Mesh mesh = read_model(folder / "a.ply").mesh;
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[1]] - mesh.positions[t[0]];
    EXPECT_GT(a.cross(mesh.positions[t[2]] - mesh.positions[t[0]]).z(), 0);
  }
}

TEST(MeshFile, GltfTurnsUvsUpAndKeepsTangents) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.glb", "a.gltf"}) {
    SCOPED_TRACE(name);
    GltfTriangle triangle;
    triangle.tangents = true;
    write_gltf(folder / name, triangle);
    const Model model = read_model(folder / name);
    const Mesh& mesh = model.mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[2], Vec3f(0, 1, 0));
    EXPECT_EQ(mesh.uvs[0], Vec2f(0, 0));
    EXPECT_EQ(mesh.uvs[1], Vec2f(1, 0));
    EXPECT_EQ(mesh.uvs[2], Vec2f(0, 1));
    for (const Vec4f& t : mesh.tangents) EXPECT_EQ(t, Vec4f(1, 0, 0, 1));
    EXPECT_EQ(mesh.material_names, std::vector<std::string>{"cloth"});
  }
}

TEST(MeshFile, GltfNodesMoveScaleAndMirror) {
  const TemporaryFolder folder;
  GltfTriangle triangle;
  triangle.tangents = true;
  // Column-major: x mirrored, y doubled, moved by (5, 6, 7).
  triangle.node = R"("matrix": [-1,0,0,0, 0,2,0,0, 0,0,1,0, 5,6,7,1])";
  write_gltf(folder / "a.glb", triangle);
  const Mesh mesh = read_model(folder / "a.glb").mesh;
  EXPECT_EQ(mesh.positions[1], Vec3f(4, 6, 7));
  EXPECT_EQ(mesh.positions[2], Vec3f(5, 8, 7));
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
  EXPECT_EQ(mesh.tangents[0], Vec4f(-1, 0, 0, -1));
  // Winding and normals still agree.
  const auto& t = mesh.triangles[0];
  const Vec3f cross =
      (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
  EXPECT_GT(cross.z(), 0);
}

// A shear along the plane leaves the plane's normal; a parent moves what its child has moved.
TEST(MeshFile, GltfNodesShearAndNest) {
  const TemporaryFolder folder;
  GltfTriangle triangle;
  triangle.node = R"("matrix": [1,0,0,0, 0,1,0,0, 1,0,1,0, 0,0,0,1])";
  write_gltf(folder / "a.gltf", triangle);
  EXPECT_LT((read_model(folder / "a.gltf").mesh.normals.at(0) - Vec3f::UnitZ()).norm(), 1e-6f);
  triangle.node.clear();
  write_gltf(folder / "a.gltf", triangle);
  std::string text = read_text(folder / "a.gltf");
  const std::string single = R"("nodes": [{"mesh": 0}])";
  ASSERT_NE(text.find(single), std::string::npos);
  text.replace(text.find(single), single.size(),
               R"("nodes": [{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [1, 0, 0]}])");
  write_text(folder / "a.gltf", text);
  EXPECT_EQ(read_model(folder / "a.gltf").mesh.positions.at(0), Vec3f(2, 0, 0));
}

TEST(MeshFile, TangentsWithoutDirectionAreMended) {
  const TemporaryFolder folder;
  GltfTriangle triangle;
  triangle.tangents = true;
  triangle.tangent_values[1] = {0, 0, 0, 1};
  triangle.tangent_values[2] = {0, 0, 1, 1};  // along the normal
  write_gltf(folder / "a.glb", triangle);
  for (const Vec4f& t : read_model(folder / "a.glb").mesh.tangents) EXPECT_EQ(t.head<3>(), Vec3f(1, 0, 0));
  triangle.tangent_values.fill({0.6f, 0, 0.8f, 1});  // not across the normal
  write_gltf(folder / "a.glb", triangle);
  for (const Vec4f& t : read_model(folder / "a.glb").mesh.tangents)
    EXPECT_LT((t.head<3>() - Vec3f::UnitX()).norm(), 1e-6f);
}

TEST(MeshFile, GltfPicturesWithTheirTransform) {
  const TemporaryFolder folder;
  Image normals(2, 2, 3, 0.5f);
  normals.at(0, 0, 2) = 1;
  write_data(folder / "normals map.png", normals);
  for (const bool embedded : {false, true}) {
    SCOPED_TRACE(embedded);
    GltfTriangle triangle;
    triangle.picture_uri = "normals%20map.png";
    if (embedded) triangle.picture = read_bytes(folder / "normals map.png");
    write_gltf(folder / "a.glb", triangle);
    const MeshMaterial material = read_model(folder / "a.glb").materials.at(0);
    ASSERT_EQ(material.normal_map.width, 2);
    EXPECT_NEAR(material.normal_map.at(0, 0, 0), 0.5, 1e-4);
    EXPECT_EQ(material.normal_map.at(0, 0, 2), 1);
    ASSERT_EQ(material.occlusion_map.height, 2);
    // offset (0.1, 0.2), scale (4, 8) with v down: v' = 1 - (8 (1 - v) + 0.2) with v up.
    EXPECT_LT((material.normal_uv_scale - Vec2f(4, 8)).norm(), 1e-6f);
    EXPECT_LT((material.normal_uv_offset - Vec2f(0.1f, -7.2f)).norm(), 1e-5f);
    EXPECT_EQ(material.occlusion_uv_scale, Vec2f(1, 1));
    EXPECT_EQ(material.occlusion_uv_offset, Vec2f(0, 0));
  }
  GltfTriangle triangle;
  triangle.picture_uri = "none.png";
  write_gltf(folder / "missing.glb", triangle);
  EXPECT_THROW(read_model(folder / "missing.glb"), Error);
}

TEST(MeshFile, ATruncatedGlbIsAnErrorAtAnyLength) {
  const TemporaryFolder folder;
  GltfTriangle triangle;
  triangle.tangents = true;
  write_gltf(folder / "a.glb", triangle);
  const std::string bytes = read_text(folder / "a.glb");
  for (std::size_t length = 0; length < bytes.size(); length += 37) {
    test::put_text(folder / "cut.glb", bytes.substr(0, length));
    EXPECT_NE(error_of(folder / "cut.glb"), "no error") << length;
  }
}

TEST(MeshFile, WhatIsNoMeshIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(folder / "none.obj"), HasSubstr("no such file"));
  test::put_text(folder / "a.txt", "hello");
  EXPECT_THAT(error_of(folder / "a.txt"), HasSubstr(".obj, .ply, .glb, .gltf"));
  for (const std::string name : {"a.obj", "a.ply", "a.glb", "a.gltf"}) {
    test::put_text(folder / name, "this is no mesh\n");
    EXPECT_NE(error_of(folder / name), "no error");
    test::put_text(folder / name, "");
    EXPECT_NE(error_of(folder / name), "no error");
  }
  test::put_text(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_THAT(error_of(folder / "points.obj"), HasSubstr("no triangles"));
  test::put_text(folder / "line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  EXPECT_THAT(error_of(folder / "line.obj"), HasSubstr("no triangles"));
  test::put_text(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  EXPECT_THAT(error_of(folder / "flat.obj"), HasSubstr("no triangles"));
}

TEST(MeshFile, IndicesOutsideTheMeshAreErrors) {
  const TemporaryFolder folder;
  test::put_text(folder / "a.obj", fmt::format("{}f 1 2 9\n", kSquare));
  EXPECT_NE(error_of(folder / "a.obj"), "no error");
  for (const char* last : {"7", "3", "-1"}) {
    test::put_text(folder / "a.ply",
                   fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 {}\n",
                               last));
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr(fmt::format("face 0 uses vertex {}", last)));
  }
  GltfTriangle triangle;
  triangle.last_index = 9;
  write_gltf(folder / "a.glb", triangle);
  EXPECT_NE(error_of(folder / "a.glb"), "no error");
}

/// A glTF of one triangle whose positions are sparse: element `replaced` is moved to x = 5.
std::string sparse_gltf(int replaced, const std::string& nodes, const std::string& roots = "0") {
  const std::array<float, 12> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0};
  std::string bytes(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  bytes += static_cast<char>(replaced);
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  bytes.resize(51);
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t b = 0; b < 3; ++b) bits = bits << 8 | static_cast<unsigned char>(bytes[i + b]);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) base64 += kDigits[bits >> shift & 63];
  }
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
    "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
    "buffers": [{{"byteLength": 51, "uri": "data:application/octet-stream;base64,{}"}}],
    "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 12}},
                    {{"buffer": 0, "byteOffset": 48, "byteLength": 1}}],
    "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                    "sparse": {{"count": 1, "indices": {{"bufferView": 2, "componentType": 5121}},
                                "values": {{"bufferView": 1}}}}}}]}})",
      roots, nodes, base64);
}

TEST(MeshFile, SparseElementsOutsideTheirAccessorAreErrors) {
  const TemporaryFolder folder;
  const auto path = folder / "a.gltf";
  test::put_text(path, sparse_gltf(1, R"({"mesh": 0})"));
  const Mesh mesh = read_model(path).mesh;
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[1], Vec3f(5, 0, 0));
  test::put_text(path, sparse_gltf(3, R"({"mesh": 0})"));
  EXPECT_THAT(error_of(path), HasSubstr("replaces element 3, there are 3"));
}

TEST(MeshFile, NodesThatAreNoTreesAreErrors) {
  const TemporaryFolder folder;
  const auto path = folder / "a.gltf";
  const auto fault = [&](const std::string& nodes, const std::string& roots = "0") {
    test::put_text(path, sparse_gltf(1, nodes, roots));
    return error_of(path);
  };
  std::string doubling;  // a billion triangles
  for (int i = 0; i < 30; ++i) doubling += fmt::format(R"({{"children": [{0}, {0}]}}, )", i + 1);
  EXPECT_THAT(fault(doubling + R"({"mesh": 0})"), HasSubstr("two parents"));
  EXPECT_THAT(fault(R"({"children": [1]}, {"children": [0], "mesh": 0})"), HasSubstr("in a circle"));
  EXPECT_THAT(fault(R"({"mesh": 0, "children": [7]})"), HasSubstr("child 7"));
  EXPECT_THAT(fault(R"({"mesh": 0})", "0, 0, 0"), HasSubstr("twice"));
  std::string chain;
  for (int i = 0; i < 1500; ++i) chain += fmt::format(R"({{"children": [{}]}}, )", i + 1);
  EXPECT_THAT(fault(chain + R"({"mesh": 0})"), HasSubstr("1000 levels"));
  std::string deep(100000, '[');
  test::put_text(path, R"({"asset": {"version": "2.0"}, "extras": )" + deep);
  EXPECT_THAT(error_of(path), HasSubstr("levels deep"));
}

TEST(MeshFile, PositionsAndTextureCoordinatesThatAreNotFiniteAreNamed) {
  const TemporaryFolder folder;
  test::put_text(folder / "a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(error_of(folder / "a.obj"), HasSubstr("not finite"));
  GltfTriangle triangle;
  triangle.first_x = std::numeric_limits<float>::quiet_NaN();
  write_gltf(folder / "a.glb", triangle);
  EXPECT_THAT(error_of(folder / "a.glb"), HasSubstr("vertex 0 has a position that is not finite"));
  for (const bool uv : {false, true}) {
    write_text(folder / "a.ply",
               fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nproperty float s\nproperty float t\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 {} 1 {}\n"
                           "0 1 0 0 1\n3 0 1 2\n",
                           uv ? "0" : "nan", uv ? "inf" : "0"));
    EXPECT_THAT(error_of(folder / "a.ply"),
                HasSubstr(uv ? "vertex 1 has texture coordinates" : "vertex 1 has a position"));
  }
}

TEST(MeshFile, ClaimedSizesAreCheckedBeforeMemoryIsAskedFor) {
  const TemporaryFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian"}) {
    test::put_text(
        folder / "a.ply",
        fmt::format(
            "ply\nformat {} 1.0\nelement vertex 1099511627776\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
            format));
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("truncated"));
  }
  GltfTriangle triangle;
  triangle.vertex_count = 1ull << 40;
  write_gltf(folder / "a.glb", triangle);
  EXPECT_THAT(error_of(folder / "a.glb"), HasSubstr("1099511627776 elements"));
  for (const std::uint64_t count : {4u, 5u}) {
    triangle.vertex_count = count;
    write_gltf(folder / "a.glb", triangle);
    EXPECT_THAT(error_of(folder / "a.glb"), HasSubstr("past its buffer view")) << count;
  }
  write_gltf(folder / "a.gltf", {});
  std::string text = read_text(folder / "a.gltf");
  const std::string last = "\"byteOffset\": 108, \"byteLength\": 48";
  ASSERT_NE(text.find(last), std::string::npos);
  text.replace(text.find(last), last.size(), "\"byteOffset\": 108, \"byteLength\": 52");
  write_text(folder / "a.gltf", text);
  EXPECT_THAT(error_of(folder / "a.gltf"), HasSubstr("buffer view that reaches past its buffer"));
}

}  // namespace
}  // namespace sateen::io
