// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

// Heavy to compile: include it in .cpp files only. Texts from files are parsed here and nowhere else
// (tests/layers).

namespace sateen::io {

/// The value that `text` spells; `name` is what messages call it. Throws Error when it is no JSON or nested
/// more than 64 levels deep, which the parser, being recursive, must never see.
nlohmann::json parse_json(const std::string& text, const std::string& name);

/// The same for a file. Throws Error naming it when it is missing, no JSON, or nested too deep.
nlohmann::json read_json(const std::filesystem::path& path);

/// The text of a value, on one line or indented; bytes that are no UTF-8, as file names may have, become
/// U+FFFD.
std::string json_text(const nlohmann::json& value, int indent = -1);
std::string json_text(const nlohmann::ordered_json& value, int indent = -1);

}  // namespace sateen::io
