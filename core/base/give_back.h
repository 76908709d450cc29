// Memory that is given back without anybody's waiting for it.
#pragma once

#include "core/base/thread_priority.h"

#include <exception>
#include <thread>

namespace ramus {

// Does `work`, which gives memory back, on a thread of its own that gives way: the system takes long for many pages,
// and whoever is the last to need them may have no time. Here and now where the system has no more threads.
template <class Work> void give_back_elsewhere(const Work& work) noexcept {
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
