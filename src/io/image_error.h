// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sateen/io/file_error.h"

namespace sateen::io {

/// OpenImageIO's message in the shape of ours: no newline, no full stop at its end.
inline std::string image_reason(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  return message.empty() ? "unknown reason" : message;
}

}  // namespace sateen::io
