// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace sateen::gpu {

/// Wall clock around finished GPU work; timer queries lie on software drivers.
class Timer {
 public:
  Timer() { restart(); }
  /// Waits for all earlier work, then starts the clock.
  void restart();
  /// Waits for all work so far; seconds since the start.
  double seconds() const;

 private:
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sateen::gpu
