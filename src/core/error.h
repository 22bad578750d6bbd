// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace sateen {

/// A wrong input: the message names the file or option, what is wrong, and what would be right. Library
/// functions throw it; programs catch it once, in main, and exit with code 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Calls `work` and returns what went wrong, whatever it threw, or an empty text: of many things each fails
/// alone. An Error's message stands as it is, others are told of `name`.
std::string failure_of(const std::string& name, const std::function<void()>& work);

}  // namespace sateen
