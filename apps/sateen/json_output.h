// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace sateen::cli {

/// The text of a JSON value, ordered or not; bytes that are no UTF-8, as file names may have, become U+FFFD.
template <class Json>
std::string json_text(const Json& value, int indent = 2) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sateen::cli
