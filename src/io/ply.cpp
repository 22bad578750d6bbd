// SPDX-License-Identifier: MIT
#include "sateen/io/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"
#include "sateen/io/ply_header.h"
#include "sateen/io/triangulate.h"

namespace sateen::io {
namespace {

[[noreturn]] void truncated() {
  throw Error("is truncated: it ends before its last element");
}

// Takes one value after the other from the bytes behind the header.
class TextValues {
 public:
  explicit TextValues(std::string_view bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}
  double next(PlyType) {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    if (at_ == end_) truncated();
    if (*at_ == '+') ++at_;
    double value = 0;
    const auto [after, code] = std::from_chars(at_, end_, value);
    if (code == std::errc::result_out_of_range) value = std::abs(value) < 1 ? 0 : HUGE_VAL;
    if (code == std::errc::invalid_argument) {
      throw Error(fmt::format(
          "has '{}' where a number should be",
          std::string_view(at_, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end_ - at_, 12)))));
    }
    at_ = after;
    return value;
  }

 private:
  const char* at_;
  const char* end_;
};

template <bool kSwap>
class BinaryValues {
 public:
  explicit BinaryValues(std::string_view bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}
  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      default:
        return take<double>();
    }
  }

 private:
  template <class T>
  T take() {
    if (end_ - at_ < static_cast<std::ptrdiff_t>(sizeof(T))) truncated();
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), at_, sizeof(T));
    if constexpr (kSwap) std::ranges::reverse(raw);
    at_ += sizeof(T);
    return std::bit_cast<T>(raw);
  }
  const char* at_;
  const char* end_;
};

template <class Values>
void skip(Values& values, const PlyProperty& property) {
  double count = property.list ? values.next(property.count_type) : 1;
  for (; count >= 1; --count) values.next(property.type);
}

bool has(const PlyElement& element, const char* name) {
  return std::ranges::any_of(element.properties,
                             [&](const PlyProperty& p) { return p.name == name && !p.list; });
}

template <class Values>
void read_vertices(Values& values, const PlyElement& element, Mesh& mesh) {
  // Places in a row of x, y, z, nx, ny, nz, u, v.
  static const std::map<std::string, std::size_t> kPlaces = {
      {"x", 0}, {"y", 1}, {"z", 2}, {"nx", 3}, {"ny", 4},        {"nz", 5},
      {"u", 6}, {"s", 6}, {"v", 7}, {"t", 7},  {"texture_u", 6}, {"texture_v", 7}};
  constexpr std::size_t kIgnored = 8;
  if (!has(element, "x") || !has(element, "y") || !has(element, "z"))
    throw Error("has vertices without x, y and z");
  std::vector<std::size_t> places;
  std::array<bool, 9> present{};
  for (const PlyProperty& property : element.properties) {
    const auto found = kPlaces.find(property.name);
    places.push_back(found == kPlaces.end() || property.list ? kIgnored : found->second);
    present[places.back()] = true;
  }
  const bool normals = present[3] && present[4] && present[5];
  const bool uvs = present[6] && present[7];
  mesh.positions.reserve(element.count);
  if (normals) mesh.normals.reserve(element.count);
  if (uvs) mesh.uvs.reserve(element.count);
  std::array<float, 9> row{};
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.list) {
        skip(values, property);
      } else {
        row[places[p]] = static_cast<float>(values.next(property.type));
      }
    }
    mesh.positions.emplace_back(row[0], row[1], row[2]);
    if (normals) mesh.normals.push_back(Vec3f(row[3], row[4], row[5]).normalized());
    if (uvs) mesh.uvs.emplace_back(row[6], row[7]);
  }
}

// Adds the triangles of a polygon, or of strips separated by -1.
void add_polygon(const std::vector<std::uint32_t>& corners, Mesh& mesh) {
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  std::vector<Vec3f> positions;
  for (const std::uint32_t corner : corners) positions.push_back(mesh.positions[corner]);
  for (const auto& t : triangulate(positions)) {
    mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }
}

void add_strip(const std::vector<std::uint32_t>& corners, Mesh& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const bool odd = i % 2 == 1;
    mesh.triangles.push_back({corners[i - 2], corners[odd ? i : i - 1], corners[odd ? i - 1 : i]});
  }
}

template <class Values>
void read_faces(Values& values, const PlyElement& element, Mesh& mesh) {
  const bool strips = element.name == "tristrips";
  if (!strips) mesh.triangles.reserve(mesh.triangles.size() + element.count);
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (!property.list || (property.name != "vertex_indices" && property.name != "vertex_index")) {
        skip(values, property);
        continue;
      }
      corners.clear();
      for (double count = values.next(property.count_type); count >= 1; --count) {
        const double index = values.next(property.type);
        if (strips && index == -1) {
          add_strip(corners, mesh);
          corners.clear();
        } else if (index >= 0 && index < static_cast<double>(mesh.positions.size())) {
          corners.push_back(static_cast<std::uint32_t>(index));
        } else {
          throw Error(fmt::format("face {} uses vertex {}, there are {}", i, index, mesh.positions.size()));
        }
      }
      (strips ? add_strip : add_polygon)(corners, mesh);
    }
  }
}

template <class Values>
Mesh read_elements(Values values, const PlyHeader& header) {
  Mesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      if (element.count >= std::numeric_limits<std::uint32_t>::max())
        throw Error("has more than 4294967294 vertices");
      if (!mesh.positions.empty()) throw Error("has two lists of vertices; one is needed");
      read_vertices(values, element, mesh);
    } else if (element.name == "face" || element.name == "tristrips") {
      read_faces(values, element, mesh);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) skip(values, property);
      }
    }
  }
  return mesh;
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_bytes(path);
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    const PlyHeader header = read_ply_header(all);
    const std::string_view rest = all.substr(header.size);
    if (header.format == PlyHeader::Format::text) return read_elements(TextValues(rest), header);
    const bool big = header.format == PlyHeader::Format::big_endian;
    if (big == (std::endian::native == std::endian::big))
      return read_elements(BinaryValues<false>(rest), header);
    return read_elements(BinaryValues<true>(rest), header);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace sateen::io
