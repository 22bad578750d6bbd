// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace sateen {

/// The middle value (the upper of two); `values` must not be empty.
template <typename T>
double median(std::vector<T> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  return static_cast<double>(*half);
}

}  // namespace sateen
