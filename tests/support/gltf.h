// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sateen/io/file.h"

namespace sateen::test {

/// A right triangle in the xy plane as a glTF file, with the faults and extras a test asks for.
struct GltfTriangle {
  bool tangents = false;
  std::array<std::array<float, 4>, 3> tangent_values = {{{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}}};
  float first_x = 0;
  std::uint32_t last_index = 2;
  std::uint64_t vertex_count = 3;  ///< what the accessors claim
  std::string node;                ///< members of the node, JSON without braces
  std::string picture_uri;         ///< of normal map (tiled 4 x 8, moved by 0.1, 0.2) and occlusion map
  std::vector<std::byte> picture;  ///< embedded instead of the URI
};

/// .glb with one binary chunk, or .gltf with "buffer.bin" beside it.
inline void write_gltf(const std::filesystem::path& path, const GltfTriangle& triangle) {
  std::vector<std::byte> binary;
  std::string views;
  const auto add_view = [&](const void* data, std::size_t size) {
    views += fmt::format("{}{{\"buffer\": 0, \"byteOffset\": {}, \"byteLength\": {}}}",
                         views.empty() ? "" : ", ", binary.size(), size);
    const auto* bytes = static_cast<const std::byte*>(data);
    binary.insert(binary.end(), bytes, bytes + size);
    while (binary.size() % 4 != 0) binary.push_back(std::byte{0});
  };
  const std::array<float, 9> positions = {triangle.first_x, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::array<float, 9> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  const std::array<float, 6> uvs = {0, 1, 1, 1, 0, 0};  // v down
  const std::array<std::uint32_t, 3> indices = {0, 1, triangle.last_index};
  add_view(positions.data(), sizeof(positions));
  add_view(normals.data(), sizeof(normals));
  add_view(uvs.data(), sizeof(uvs));
  add_view(indices.data(), sizeof(indices));
  add_view(triangle.tangent_values.data(), sizeof(triangle.tangent_values));
  if (!triangle.picture.empty()) add_view(triangle.picture.data(), triangle.picture.size());

  std::string textures;
  std::string maps;
  if (!triangle.picture_uri.empty()) {
    textures = fmt::format(
        R"("images": [{{{}}}], "textures": [{{"source": 0}}], "extensionsUsed": ["KHR_texture_transform"],)",
        triangle.picture.empty() ? fmt::format(R"("uri": "{}")", triangle.picture_uri)
                                 : std::string(R"("bufferView": 5, "mimeType": "image/png")"));
    maps =
        R"(, "normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.1, 0.2], "scale": [4, 8]}}},
           "occlusionTexture": {"index": 0})";
  }
  const bool glb = path.extension() == ".glb";
  const auto accessor = [&](int view, int type, std::uint64_t count, const char* shape,
                            const char* extra = "") {
    return fmt::format(R"({{"bufferView": {}, "componentType": {}, "count": {}, "type": "{}"{}}})", view,
                       type, count, shape, extra);
  };
  const std::uint64_t count = triangle.vertex_count;
  std::string json = fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
      "nodes": [{{"mesh": 0{}{}}}], {} "materials": [{{"name": "cloth"{}}}],
      "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2{}}}, "indices": 3, "material": 0}}]}}],
      "accessors": [{}, {}, {}, {}, {}], "bufferViews": [{}],
      "buffers": [{{{}"byteLength": {}}}]}})",
      triangle.node.empty() ? "" : ", ", triangle.node, textures, maps,
      triangle.tangents ? R"(, "TANGENT": 4)" : "",
      accessor(0, 5126, count, "VEC3", R"(, "min": [0, 0, 0], "max": [1, 1, 0])"),
      accessor(1, 5126, count, "VEC3"), accessor(2, 5126, count, "VEC2"), accessor(3, 5125, 3, "SCALAR"),
      accessor(4, 5126, count, "VEC4"), views, glb ? "" : R"("uri": "buffer.bin", )", binary.size());
  if (!glb) {
    io::write_bytes(path.parent_path() / "buffer.bin", binary);
    io::write_text(path, json);
    return;
  }
  while (json.size() % 4 != 0) json += ' ';
  std::string bytes;
  const auto put = [&](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    char raw[4];
    std::memcpy(raw, &word, 4);
    bytes.append(raw, 4);
  };
  put(0x46546C67);
  put(2);
  put(12 + 8 + json.size() + 8 + binary.size());
  put(json.size());
  put(0x4E4F534A);
  bytes += json;
  put(binary.size());
  put(0x004E4942);
  bytes.append(reinterpret_cast<const char*>(binary.data()), binary.size());
  io::write_text(path, bytes);
}

}  // namespace sateen::test
