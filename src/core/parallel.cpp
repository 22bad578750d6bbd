// SPDX-License-Identifier: MIT
#include "sateen/core/parallel.h"

#include <memory>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace sateen {

void parallel_for(int count, const std::function<void(int)>& body) {
  // A context of its own: oneTBB would otherwise cancel this loop, without a word, when a loop around it
  // stops for an exception somewhere else, and what is half-done here would pass for done.
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  tbb::parallel_for(0, count, body, alone);
}

void limit_threads(int threads) {
  static std::unique_ptr<tbb::global_control> control;
  control.reset();
  if (threads > 0) {
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
  }
}

int thread_limit() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace sateen
