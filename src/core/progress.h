// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace sateen {

/// Told by long library functions how far they are, as a fraction in [0, 1]; may be called from any thread,
/// and may be empty. Libraries report, they never print.
using Progress = std::function<void(double fraction)>;

inline void report(const Progress& progress, double fraction) {
  if (progress) progress(fraction);
}

}  // namespace sateen
