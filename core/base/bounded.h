// Work that keeps within what it may have: threads and memory.
#pragma once

#include "core/base/thread_priority.h"

#include <new>
#include <oneapi/tbb/task_arena.h>
#include <tl/expected.hpp>

namespace ramus {

// In as many threads as asked for, all there are with 0, and with the error that `at_memory_end` makes instead of an
// exception when memory ends.
template <class AtMemoryEnd, class Work>
auto bounded(int threads, const AtMemoryEnd& at_memory_end, const Work& work) -> decltype(work()) {
    try {
        if (threads <= 0) return work();
        tbb::task_arena arena(threads);
        const LowPriorityHelpers helpers(arena);
        return arena.execute(work);
    } catch (const std::bad_alloc&) {
        return tl::unexpected(at_memory_end());
    }
}

} // namespace ramus
