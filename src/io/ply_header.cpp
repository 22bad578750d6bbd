// SPDX-License-Identifier: MIT
#include "sateen/io/ply_header.h"

#include <map>
#include <sstream>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::io {
namespace {

PlyType type_named(const std::string& name) {
  using enum PlyType;
  static const std::map<std::string, PlyType> kTypes = {
      {"char", int8},     {"uchar", uint8},     {"short", int16},    {"ushort", uint16},
      {"int", int32},     {"uint", uint32},     {"int8", int8},      {"uint8", uint8},
      {"int16", int16},   {"uint16", uint16},   {"int32", int32},    {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) throw Error(fmt::format("has a PLY property of unknown type '{}'", name));
  return found->second;
}

void check_length(const PlyHeader& header, std::size_t there) {
  double least = 0;
  for (const PlyElement& element : header.elements) {
    for (const PlyProperty& property : element.properties) {
      const int size = size_of(property.list ? property.count_type : property.type);
      // In a text a digit and a blank.
      least += static_cast<double>(element.count) * (header.format == PlyHeader::Format::text ? 2 : size);
    }
  }
  if (static_cast<double>(there) + 1 < least) {
    throw Error(
        fmt::format("is truncated: its header asks for at least {:.0f} bytes, {} follow", least, there));
  }
}

}  // namespace

int size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

PlyHeader read_ply_header(std::string_view bytes) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r\n")) throw Error("is not a PLY file");
  PlyHeader header;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string_view::npos) break;
    const std::string line(bytes.substr(begin, end - begin));
    begin = end + 1;
    std::istringstream words(line);
    std::string key;
    std::string word;
    words >> key >> word;
    const auto need = [&](bool good) {
      if (!good) throw Error(fmt::format("has a broken PLY header: '{}'", line.substr(0, 80)));
    };
    if (key == "format") {
      need(word == "ascii" || word == "binary_little_endian" || word == "binary_big_endian");
      header.format = word == "ascii"                  ? PlyHeader::Format::text
                      : word == "binary_little_endian" ? PlyHeader::Format::little_endian
                                                       : PlyHeader::Format::big_endian;
    } else if (key == "element") {
      header.elements.push_back({word, 0, {}});
      need(static_cast<bool>(words >> header.elements.back().count));
    } else if (key == "property") {
      need(!header.elements.empty());
      PlyProperty property;
      property.list = word == "list";
      if (property.list) {
        words >> word;
        property.count_type = type_named(word);
        words >> word;
      }
      property.type = type_named(word);
      need(static_cast<bool>(words >> property.name));
      header.elements.back().properties.push_back(property);
    } else if (key == "end_header") {
      header.size = begin;
      check_length(header, bytes.size() - begin);
      return header;
    }
  }
  throw Error("is truncated: its PLY header has no end");
}

}  // namespace sateen::io
