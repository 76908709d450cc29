// Lowers the priority of background threads, so that the threads that draw the screen run first.
#pragma once

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

namespace ramus {

// Lowers the priority of the calling thread, irrevocably (setpriority(2), which Linux applies to one thread). Does
// nothing where the system does not allow it, and on systems other than Linux.
void lower_thread_priority();
[[nodiscard]] bool has_low_priority(); // of the calling thread

// Lowers the priority of TBB's worker threads that join parallel work of the constructing thread, or of an arena, while
// this object lives. Does nothing unless the constructing thread has low priority. The workers keep the low priority.
class LowPriorityHelpers : public tbb::task_scheduler_observer {
public:
    LowPriorityHelpers() { observe(has_low_priority()); }
    explicit LowPriorityHelpers(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) {
        observe(has_low_priority());
    }
    ~LowPriorityHelpers() override { observe(false); }
    LowPriorityHelpers(const LowPriorityHelpers&) = delete;
    LowPriorityHelpers& operator=(const LowPriorityHelpers&) = delete;

    void on_scheduler_entry(bool helps) override {
        if (helps) lower_thread_priority();
    }
};

} // namespace ramus
