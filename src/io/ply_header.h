// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sateen::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
int size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type{};
  bool list = false;
  PlyType count_type{};  ///< of the length in front of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { text, little_endian, big_endian };
  Format format = Format::text;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes up to the first element
};

/// The header of a PLY file's bytes. Throws Error (its message without the file's name) when it is broken or
/// when what follows is shorter than the elements need at least.
PlyHeader read_ply_header(std::string_view bytes);

}  // namespace sateen::io
