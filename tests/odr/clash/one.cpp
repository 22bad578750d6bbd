// SPDX-License-Identifier: MIT
// Wrong on purpose: another file defines another struct of this name.
#include <string>

namespace sateen {

struct Twice {
  std::string text;
};

std::size_t of_one() {
  return Twice{"text"}.text.size();
}

}  // namespace sateen
