// SPDX-License-Identifier: MIT
#include "sateen/gpu/timer.h"

#include <epoxy/gl.h>

namespace sateen::gpu {

void Timer::restart() {
  glFinish();
  start_ = std::chrono::steady_clock::now();
}

double Timer::seconds() const {
  glFinish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace sateen::gpu
