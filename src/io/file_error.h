// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::io {

/// Throws Error: the file, then what is wrong with it.
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

}  // namespace sateen::io
