// SPDX-License-Identifier: MIT
#include "sateen/capture/table/clipping.h"

#include <algorithm>

#include <fmt/format.h>

#include "sateen/capture/table/stack.h"

namespace sateen::capture {

Clipping count_clipped(const RectifiedStack& stack) {
  double clipped = 0;
  double samples = 0;
  Clipping clipping;
  clipping.picture = Image(stack.size, stack.size, 1);
  const float share = 1 / static_cast<float>(std::max<std::size_t>(1, stack.frames.size()));
  for (const RectifiedFrame& frame : stack.frames) {
    for (std::size_t t = 0; t < frame.weight.size(); ++t) {
      samples += frame.weight[t] > 0 ? 1 : 0;
      if (frame.clipped[t] <= 127) continue;
      ++clipped;
      clipping.picture.data[t] += share;
    }
  }
  clipping.share = samples > 0 ? clipped / samples : 0;
  return clipping;
}

std::vector<std::string> advice(const Clipping& clipping) {
  if (clipping.share <= 0.01) return {};
  return {
      fmt::format("{:.1f} % of the material is clipped: highlights will look flat. Expose shorter, or "
                  "bracket exposures",
                  100 * clipping.share)};
}

}  // namespace sateen::capture
