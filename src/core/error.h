// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace sateen {

/// A wrong input: the message names the file or option, what is wrong, and what would be right. Library
/// functions throw it; programs catch it once, in main, and exit with code 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sateen
