#include "core/base/error.h"
#include "core/base/free_in_background.h"
#include "core/base/run_limited.h"
#include "core/base/thread_priority.h"
#include "core/base/worker.h"

#include <atomic>
#include <chrono>
#include <doctest/doctest.h>
#include <functional>
#include <future>
#include <memory>
#include <oneapi/tbb/parallel_for.h>
#include <thread>
#include <utility>

using namespace ramus;

namespace {

// Whether a helper thread with low priority takes part in parallel work within this number of tries.
bool helper_has_low_priority(int tries) {
    const auto self = std::this_thread::get_id();
    std::atomic<bool> does = false;
    for (int i = 0; i < tries && !does; ++i)
        tbb::parallel_for(0, 8, [&](int) {
            if (std::this_thread::get_id() != self && has_low_priority()) does = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
    return does;
}

bool arena_helper_has_low_priority(int tries) {
    const auto no_memory = [] { return Error{"no memory", {}, {}}; };
    return run_limited(2, no_memory, [&]() -> Result<bool> { return helper_has_low_priority(tries); }).value();
}

void run(Worker& worker, const std::function<void()>& work) {
    worker.start("Working", [&](Job&, const Worker::Post&) { work(); });
    while (worker.busy()) {
        worker.wait(std::chrono::milliseconds(50));
        worker.drain();
    }
}

// Helper threads keep their low priority. So each case needs a process of its own, as it has under ctest.
const bool kHasHelpers = std::thread::hardware_concurrency() > 1;

} // namespace

TEST_CASE("thread priority: a worker lowers its own, and that of the threads which help with its work") {
    const bool before = has_low_priority();
    Worker worker([] {});
    bool worker_does = false, helper_does = false;
    run(worker, [&] {
        worker_does = has_low_priority();
        helper_does = helper_has_low_priority(1000);
    });
    CHECK(worker_does);
    CHECK(has_low_priority() == before);
    CHECK(helper_does == kHasHelpers);
}

TEST_CASE("thread priority: helpers in an arena take that of the calling thread") {
    Worker worker([] {});
    bool helper_does = false;
    run(worker, [&] { helper_does = arena_helper_has_low_priority(1000); });
    CHECK(helper_does == kHasHelpers);
}

TEST_CASE("thread priority: memory is freed on another thread, which has a low one") {
    const auto done = std::make_shared<std::promise<std::pair<std::thread::id, bool>>>();
    free_in_background([done] { done->set_value({std::this_thread::get_id(), has_low_priority()}); });
    const std::pair by = done->get_future().get();
    CHECK(by.first != std::this_thread::get_id());
    CHECK(by.second);
}
