// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace sateen {

/// Calls body(i) for every i in [0, count), on as many threads as limit_threads allows, in no particular
/// order. When it returns, all calls were made: an exception thrown by a body is rethrown here once the
/// others have stopped, and a loop inside another goes on whatever becomes of that. The only way to loop in
/// parallel (tests/layers).
void parallel_for(int count, const std::function<void(int)>& body);

/// Bounds the threads of every later parallel_for in this process; 0 means all processors.
void limit_threads(int threads);

/// That many.
int thread_limit();

}  // namespace sateen
