// Threads whose work somebody waits for less than for what is on the screen.
#pragma once

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

namespace ramus {

// From now on the calling thread gets the processor after those that have not called this (setpriority(2): with Linux
// a thread's own matter). Where the system does not allow it nothing happens. There is no way back.
void give_way();
[[nodiscard]] bool gives_way(); // the calling thread

// While it lives, threads that come to help with parallel work give way where who made this does: work of its own, or
// in an arena. They go on to do so.
class HelpersGiveWay : public tbb::task_scheduler_observer {
public:
    HelpersGiveWay() { observe(gives_way()); }
    explicit HelpersGiveWay(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) { observe(gives_way()); }
    ~HelpersGiveWay() override { observe(false); }
    HelpersGiveWay(const HelpersGiveWay&) = delete;
    HelpersGiveWay& operator=(const HelpersGiveWay&) = delete;

    void on_scheduler_entry(bool helps) override {
        if (helps) give_way();
    }
};

} // namespace ramus
