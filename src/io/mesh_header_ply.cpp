// SPDX-License-Identifier: MIT
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/mesh_header.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> kSizes = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                           {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                           {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                           {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};

int size_of(const fs::path& path, const std::string& type) {
  const auto found = kSizes.find(type);
  if (found == kSizes.end())
    throw Error(fmt::format("{}: has a PLY property of unknown type '{}'", path.string(), type));
  return found->second;
}

}  // namespace

void check_ply(const fs::path& path) {
  const auto fail = [&](const std::string& what) -> void {
    throw Error(fmt::format("{}: {}", path.string(), what));
  };
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line.substr(0, 3) != "ply") fail("is not a PLY file");
  bool binary = false;
  bool ended = false;
  double elements = 0;
  double least = 0;  // bytes the elements take at least
  constexpr int kMostLines = 10000;
  for (int i = 0; i < kMostLines && !ended && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string key;
    std::string type;
    words >> key >> type;
    if (key == "end_header") ended = true;
    if (key == "format") binary = type != "ascii";
    if (key == "element" && !(words >> elements && elements >= 0 && elements < 0x1p53)) {
      fail(fmt::format("has a broken PLY header: '{}'", line));
    }
    if (key == "property") {
      std::string first = type;
      if (type == "list") words >> first;
      const int size = size_of(path, first);
      least += elements * (binary ? size : 2);  // a digit and a blank
    }
  }
  if (!ended) fail("is truncated: its PLY header has no end");
  const double there = static_cast<double>(fs::file_size(path)) - static_cast<double>(file.tellg());
  if (there + 1 < least) {
    fail(fmt::format("is truncated: its header asks for at least {:.0f} bytes, {:.0f} follow", least, there));
  }
}

}  // namespace sateen
