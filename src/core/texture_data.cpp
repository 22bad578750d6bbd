// SPDX-License-Identifier: MIT
#include "sateen/core/texture_data.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "sateen/core/vector.h"

namespace sateen {

std::vector<std::byte> half_bytes(std::span<const float> values) {
  constexpr float kLargest = 65504;
  std::vector<std::byte> bytes(values.size() * sizeof(Half));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Half half(std::clamp(values[i], -kLargest, kLargest));
    std::memcpy(bytes.data() + i * sizeof(Half), &half, sizeof(Half));
  }
  return bytes;
}

}  // namespace sateen
