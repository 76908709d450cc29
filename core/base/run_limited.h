// Runs work in a limited number of threads, and turns the end of memory, and of the disk, into an error.
#pragma once

#include "core/base/disk_pages.h"
#include "core/base/thread_priority.h"

#include <new>
#include <oneapi/tbb/task_arena.h>
#include <tl/expected.hpp>

namespace ramus {

// Returns the result of `work`, a Result. Parallel work of TBB inside it uses at most `threads` threads (0: all cores).
// Where `work` throws std::bad_alloc, returns the error that `at_memory_end` makes, and that of a DiskRefusal; other
// exceptions pass through.
template <class AtMemoryEnd, class Work>
auto run_limited(int threads, const AtMemoryEnd& at_memory_end, const Work& work) -> decltype(work()) {
    try {
        if (threads <= 0) return work();
        tbb::task_arena arena(threads);
        const LowPriorityHelpers helpers(arena);
        return arena.execute(work);
    } catch (const std::bad_alloc&) {
        return tl::unexpected(at_memory_end());
    } catch (const DiskRefusal& refusal) {
        return tl::unexpected(refusal.error);
    }
}

} // namespace ramus
