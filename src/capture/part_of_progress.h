// SPDX-License-Identifier: MIT
#pragma once

#include "sateen/core/progress.h"

namespace sateen::capture {

/// The part of `whole` from one fraction to another.
inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double fraction) { whole(from + (to - from) * fraction); };
}

}  // namespace sateen::capture
