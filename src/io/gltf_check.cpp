// SPDX-License-Identifier: MIT
#include "sateen/io/gltf_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sateen/io/file.h"
#include "sateen/io/file_error.h"
#include "sateen/io/json.h"
#include "sateen/io/mesh_material.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Size = std::uint64_t;

// Extensions that change how positions are stored; a file that requires one of them cannot be read without
// it.
constexpr std::array<std::string_view, 3> kUnreadable = {"KHR_draco_mesh_compression",
                                                         "EXT_meshopt_compression", "KHR_mesh_quantization"};

struct Document {
  json root;
  Size binary = 0;         // length of the GLB's binary chunk
  Size binary_offset = 0;  // where it begins in the file
};

Document read_glb(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto word = [&] {
    std::array<unsigned char, 4> b{};
    file.read(reinterpret_cast<char*>(b.data()), 4);
    return static_cast<Size>(b[0]) | static_cast<Size>(b[1]) << 8 | static_cast<Size>(b[2]) << 16 |
           static_cast<Size>(b[3]) << 24;
  };
  constexpr Size kGlb = 0x46546C67;
  constexpr Size kJson = 0x4E4F534A;
  constexpr Size kBinary = 0x004E4942;
  const Size size = fs::file_size(path);
  if (size < 20 || word() != kGlb) fail(path, "is not a GLB file");
  if (const Size version = word(); version != 2)
    fail(path, fmt::format("is glTF version {}, 2 is needed", version));
  if (const Size length = word(); length > size) {
    fail(path, fmt::format("is truncated: its header says {} bytes, it has {}", length, size));
  }
  const Size text_length = word();
  if (word() != kJson || text_length > size - 20)
    fail(path, "is truncated or no GLB: its JSON chunk is not whole");
  std::string text(text_length, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text_length));
  Document document{parse_json(text, path.string())};
  if (20 + text_length + 8 <= size) {
    const Size binary = word();
    if (word() == kBinary) {
      if (binary > size - 28 - text_length) fail(path, "is truncated: its binary chunk is not whole");
      document.binary = binary;
      document.binary_offset = 28 + text_length;
    }
  }
  return document;
}

Size element_size(const json& accessor) {
  static const std::map<int, Size> kBytes = {{5120, 1}, {5121, 1}, {5122, 2},
                                             {5123, 2}, {5125, 4}, {5126, 4}};
  static const std::map<std::string, Size> kCounts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                      {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  return kBytes.at(accessor.at("componentType").get<int>()) *
         kCounts.at(accessor.at("type").get<std::string>());
}

const json& list(const json& root, const char* key) {
  static const json kNone = json::array();
  return root.contains(key) ? root.at(key) : kNone;
}

Size check_buffers(const fs::path& path, const Document& document) {
  Size total = 0;
  for (const json& buffer : list(document.root, "buffers")) {
    const Size claimed = buffer.at("byteLength").get<Size>();
    Size there = document.binary;
    if (buffer.contains("uri")) {
      const std::string uri = buffer.at("uri").get<std::string>();
      if (uri.starts_with("data:")) {
        there = uri.size();
      } else {
        const fs::path beside = path.parent_path() / decoded_uri(uri);
        std::error_code code;
        there = fs::file_size(beside, code);
        if (code) fail(path, fmt::format("needs the file {} beside it, which is missing", beside.string()));
      }
    }
    if (claimed > there) {
      fail(path, fmt::format("is truncated: a buffer should have {} bytes and has {}", claimed, there));
    }
    total += claimed;
  }
  return total;
}

void check_accessors(const fs::path& path, const json& root, Size total) {
  const json& buffers = list(root, "buffers");
  const json& views = list(root, "bufferViews");
  for (const json& view : views) {
    const Size buffer = buffers.at(view.at("buffer").get<std::size_t>()).at("byteLength").get<Size>();
    const Size offset = view.value("byteOffset", Size{0});
    const Size length = view.at("byteLength").get<Size>();
    if (offset > buffer || length > buffer - offset)
      fail(path, "has a buffer view that reaches past its buffer");
  }
  for (const json& accessor : list(root, "accessors")) {
    const Size count = accessor.at("count").get<Size>();
    const Size size = element_size(accessor);
    if (count > total) fail(path, fmt::format("claims {} elements in {} bytes", count, total));
    if (!accessor.contains("bufferView") || count == 0) continue;
    const json& view = views.at(accessor.at("bufferView").get<std::size_t>());
    const Size length = view.at("byteLength").get<Size>();
    const Size stride = view.value("byteStride", size);
    const Size offset = accessor.value("byteOffset", Size{0});
    if (stride > 256 || offset > length || (count - 1) * stride + size > length - offset) {
      fail(path, "has an accessor that reaches past its buffer view");
    }
  }
}

std::vector<std::byte> decoded_base64(std::string_view text) {
  std::vector<std::byte> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<std::byte>(bits >> (count -= 8) & 255));
  }
  return bytes;
}

/// The bytes of a buffer, wherever they are kept.
std::vector<std::byte> buffer_bytes(const fs::path& path, const Document& document, const json& buffer) {
  if (!buffer.contains("uri")) {
    const std::vector<std::byte> file = read_bytes(path);
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(document.binary_offset);
    return {begin, begin + static_cast<std::ptrdiff_t>(document.binary)};
  }
  const std::string uri = buffer.at("uri").get<std::string>();
  if (uri.starts_with("data:")) return decoded_base64(std::string_view(uri).substr(uri.find(',') + 1));
  return read_bytes(path.parent_path() / decoded_uri(uri));
}

/// The part of a view that `count` elements of `size` bytes from `offset` take; it must lie in the view.
const json& view_of(const fs::path& path, const json& root, const json& place, Size count, Size size) {
  const json& view = list(root, "bufferViews").at(place.at("bufferView").get<std::size_t>());
  const Size length = view.at("byteLength").get<Size>();
  const Size offset = place.value("byteOffset", Size{0});
  if (offset > length || count > (length - offset) / size)
    fail(path, "has a sparse accessor that reaches past its buffer view");
  return view;
}

/// Sparse accessors replace elements by number: every number must be below the accessor's count.
void check_sparse(const fs::path& path, const Document& document) {
  std::map<std::size_t, std::vector<std::byte>> buffers;
  for (const json& accessor : list(document.root, "accessors")) {
    if (!accessor.contains("sparse")) continue;
    const json& sparse = accessor.at("sparse");
    const Size all = accessor.at("count").get<Size>();
    const Size count = sparse.at("count").get<Size>();
    if (count > all) fail(path, "has a sparse accessor with more elements than it replaces");
    view_of(path, document.root, sparse.at("values"), count, element_size(accessor));
    const json& indices = sparse.at("indices");
    const Size size = element_size({{"componentType", indices.at("componentType")}, {"type", "SCALAR"}});
    const json& view = view_of(path, document.root, indices, count, size);
    const std::size_t number = view.at("buffer").get<std::size_t>();
    if (!buffers.contains(number)) {
      buffers[number] = buffer_bytes(path, document, list(document.root, "buffers").at(number));
    }
    const std::vector<std::byte>& bytes = buffers[number];
    Size at = view.value("byteOffset", Size{0}) + indices.value("byteOffset", Size{0});
    if (at > bytes.size() || count > (bytes.size() - at) / size)
      fail(path, "is truncated: a buffer is not whole");
    for (Size i = 0; i < count; ++i, at += size) {
      Size index = 0;
      for (Size b = 0; b < size; ++b) index |= std::to_integer<Size>(bytes[at + b]) << (8 * b);
      if (index >= all)
        fail(path, fmt::format("has a sparse accessor that replaces element {}, there are {}", index, all));
    }
  }
}

/// The nodes must be trees, as the format says: a node with two parents would be drawn twice, and thirty such
/// in a row a billion times. Readers walk them by recursion.
void check_nodes(const fs::path& path, const json& root) {
  constexpr int kMostLevels = 1000;
  const json& nodes = list(root, "nodes");
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> parents(nodes.size(), kNone);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const json& child : list(nodes[i], "children")) {
      const std::size_t c = child.get<std::size_t>();
      if (c >= nodes.size())
        fail(path, fmt::format("node {} has the child {}, there are {} nodes", i, c, nodes.size()));
      if (parents[c] != kNone) fail(path, fmt::format("node {} has two parents; the format allows one", c));
      parents[c] = i;
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    int level = 0;
    for (std::size_t node = i; parents[node] != kNone; node = parents[node]) {
      if (++level > kMostLevels)
        fail(path, fmt::format("its nodes are nested in a circle or more than {} levels deep", kMostLevels));
    }
  }
  for (const json& scene : list(root, "scenes")) {
    std::set<std::size_t> seen;
    for (const json& node : list(scene, "nodes")) {
      if (!seen.insert(node.get<std::size_t>()).second) fail(path, "has a scene that lists a node twice");
    }
  }
}

}  // namespace

void check_gltf(const fs::path& path) {
  try {
    const Document document = extension_of(path) == ".glb" ? read_glb(path) : Document{read_json(path)};
    const std::string version = document.root.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2")) fail(path, fmt::format("is glTF version {}, 2 is needed", version));
    for (const json& extension : list(document.root, "extensionsRequired")) {
      if (std::ranges::find(kUnreadable, extension.get<std::string>()) != kUnreadable.end()) {
        fail(path,
             fmt::format("requires the glTF extension {}, which cannot be read; save it without compression",
                         extension.get<std::string>()));
      }
    }
    check_accessors(path, document.root, check_buffers(path, document));
    check_sparse(path, document);
    check_nodes(path, document.root);
  } catch (const json::exception& error) {
    fail(path, fmt::format("is not valid glTF, or is truncated: {}", error.what()));
  } catch (const std::out_of_range&) {
    fail(path, "is not valid glTF: it has an accessor of unknown type");
  }
}

}  // namespace sateen::io
