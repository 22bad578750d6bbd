// SPDX-License-Identifier: MIT
#include "sateen/core/parallel.h"

#include <memory>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#ifdef SATEEN_SANITIZED_THREADS
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace sateen {
namespace {

/// What the thread sanitizer cannot see in a oneTBB that is not instrumented: bodies come after the call and
/// before its return, and not in any order among themselves.
class Order {
 public:
#ifdef SATEEN_SANITIZED_THREADS
  Order() {
    __tsan_release(&begin_);
  }
  ~Order() {
    __tsan_acquire(&end_);
  }
  void before_body() {
    __tsan_acquire(&begin_);
  }
  void after_body() {
    __tsan_release(&end_);
  }

 private:
  char begin_ = 0;
  char end_ = 0;
#else
  void before_body() {}
  void after_body() {}
#endif
};

}  // namespace

void parallel_for(int count, const std::function<void(int)>& body) {
  // A context of its own: oneTBB would otherwise cancel this loop, without a word, when a loop around it
  // stops for an exception somewhere else, and what is half-done here would pass for done.
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  Order order;
  tbb::parallel_for(
      0, count,
      [&](int i) {
        order.before_body();
        body(i);
        order.after_body();
      },
      alone);
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
