// SPDX-License-Identifier: MIT
#include "sateen/core/parallel.h"

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sateen/core/error.h"

namespace sateen {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Parallel, EveryCallIsMadeOnce) {
  std::vector<std::atomic<int>> calls(1000);
  parallel_for(1000, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

// oneTBB cancels the loops inside a loop that stops for an exception; they returned half-done.
TEST(Parallel, ALoopInsideAFailingLoopIsStillWhole) {
  std::atomic<int> cut_short = 0;
  std::atomic<bool> failed = false;
  EXPECT_THROW(parallel_for(16,
                            [&](int i) {
                              if (i == 15) {
                                failed = true;
                                throw Error("one of them");
                              }
                              std::atomic<int> done = 0;
                              parallel_for(200, [&](int) {
                                if (!failed) std::this_thread::sleep_for(std::chrono::microseconds(200));
                                ++done;
                              });
                              if (done != 200) ++cut_short;
                            }),
               Error);
  EXPECT_EQ(cut_short, 0);
}

TEST(FailureOf, SaysWhatHappenedWhateverIsThrown) {
  EXPECT_EQ(failure_of("a.png", [] {}), "");
  EXPECT_EQ(failure_of("a.png", [] { throw Error("b.png: is empty"); }), "b.png: is empty");
  EXPECT_THAT(failure_of("a.png", [] { throw std::bad_alloc(); }), HasSubstr("a.png: needs more memory"));
  EXPECT_THAT(failure_of("a.png", [] { throw std::runtime_error("odd"); }),
              AllOf(HasSubstr("a.png"), HasSubstr("odd")));
  EXPECT_THAT(failure_of("a.png", [] { throw 3; }), HasSubstr("a.png"));
}

}  // namespace
}  // namespace sateen
