// SPDX-License-Identifier: MIT
#include "sateen/io/json.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/io/file.h"

namespace sateen::io {
namespace {

constexpr int kMostLevels = 64;

void check_depth(const std::string& text, const std::string& name) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMostLevels)
        throw Error(fmt::format("{}: nested more than {} levels deep", name, kMostLevels));
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& name) {
  check_depth(text, name);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end == text.begin() ? end : end - 1, '\n');
    throw Error(fmt::format("{}: no valid JSON: line {} cannot be read", name, line));
  } catch (const nlohmann::json::exception&) {
    throw Error(fmt::format("{}: no valid JSON: a number is out of range", name));
  }
}

nlohmann::json read_json(const std::filesystem::path& path) {
  return parse_json(read_text(path), path.string());
}

std::string json_text(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_text(const nlohmann::ordered_json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sateen::io
