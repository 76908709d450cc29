// Frees large memory on another thread, so that the caller does not wait for the system.
#pragma once

#include "core/base/thread_priority.h"

#include <exception>
#include <thread>

namespace ramus {

// Runs `work`, which frees memory and must not throw, on a detached thread with low priority and returns at once:
// freeing many pages takes the system long. Runs it on the calling thread where the system provides no more threads.
template <class Work> void free_in_background(const Work& work) noexcept {
    try {
        std::thread([work] {
            lower_thread_priority();
            work();
        }).detach();
    } catch (const std::exception&) {
        work();
    }
}

} // namespace ramus
