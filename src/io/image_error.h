// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen {

[[noreturn]] inline void image_fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(fmt::format("{}: {}", path.string(), what));
}

/// OpenImageIO's message in the shape of ours: no newline, no full stop at its end.
inline std::string image_reason(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  return message.empty() ? "unknown reason" : message;
}

}  // namespace sateen
