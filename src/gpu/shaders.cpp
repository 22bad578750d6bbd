// SPDX-License-Identifier: MIT
#include "sateen/gpu/shaders.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::gpu {
namespace {

void collect(const ShaderFile& file, std::vector<ShaderFile>& order) {
  if (std::ranges::any_of(order, [&](const ShaderFile& other) { return other.name == file.name; })) return;
  constexpr std::string_view marker = "// needs:";
  std::istringstream lines{std::string(file.text)};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(marker)) continue;
    std::istringstream words(line.substr(marker.size()));
    for (std::string word; words >> word;) collect(shader_file(word), order);
  }
  order.push_back(file);
}

}  // namespace

const ShaderFile& shader_file(std::string_view name) {
  const auto files = embedded_shaders();
  const auto found = std::ranges::find(files, name, &ShaderFile::name);
  if (found == files.end()) throw Error(fmt::format("there is no shader file {}", name));
  return *found;
}

std::vector<ShaderFile> with_needed(std::span<const std::string> names) {
  std::vector<ShaderFile> order;
  for (const std::string& name : names) collect(shader_file(name), order);
  return order;
}

std::vector<ShaderFile> with_needed(std::span<const ShaderFile> files) {
  std::vector<ShaderFile> order;
  for (const ShaderFile& file : files) collect(file, order);
  return order;
}

}  // namespace sateen::gpu
