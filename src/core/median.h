// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace sateen {

/// The middle value (the upper of two), of values that may be reordered; there must be one.
template <typename T>
T middle_of(std::vector<T>& values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  return *half;
}

template <typename T>
double median(std::vector<T> values) {
  return static_cast<double>(middle_of(values));
}

}  // namespace sateen
