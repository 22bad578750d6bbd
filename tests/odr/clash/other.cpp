// SPDX-License-Identifier: MIT
// Wrong on purpose: another file defines another struct of this name.
#include <vector>

namespace sateen {

struct Twice {
  int number = 0;
  std::vector<int> numbers;
};

std::size_t of_other() {
  return Twice{1, {2, 3}}.numbers.size();
}

}  // namespace sateen
