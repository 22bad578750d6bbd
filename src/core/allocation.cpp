// SPDX-License-Identifier: MIT
#include "sateen/core/allocation.h"

#include <limits>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace sateen {

void keep_freed_memory() {
#ifdef M_MMAP_MAX
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  // Heaps of further threads cannot hold large blocks and would map them after all.
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace sateen
