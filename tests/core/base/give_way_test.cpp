#include "core/base/bounded.h"
#include "core/base/give_back.h"
#include "core/base/give_way.h"
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

enum class Helper { kNone, kStays, kGivesWay };

// Whether one who gives way helps with work in parallel, within so many tries.
bool helper_gives_way(int tries) {
    const auto self = std::this_thread::get_id();
    std::atomic<bool> does = false;
    for (int i = 0; i < tries && !does; ++i)
        tbb::parallel_for(0, 8, [&](int) {
            if (std::this_thread::get_id() != self && gives_way()) does = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
    return does;
}

bool helper_in_arena_gives_way(int tries) {
    const auto no_memory = [] { return Error{"no memory", {}, {}}; };
    return bounded(2, no_memory, [&]() -> Result<bool> { return helper_gives_way(tries); }).value();
}

void run(Worker& worker, const std::function<void()>& work) {
    worker.start("Working", [&](Job&, const Worker::Post&) { work(); });
    while (worker.busy()) {
        worker.wait(std::chrono::milliseconds(50));
        worker.drain();
    }
}

// They go on to give way: a case shows what it is to where it has a process of its own, as ctest gives it.
const bool kHasHelpers = std::thread::hardware_concurrency() > 1;

} // namespace

TEST_CASE("give way: a worker does so, and those who help with its work") {
    const bool before = gives_way();
    Worker worker([] {});
    bool worker_does = false, helper_does = false;
    run(worker, [&] {
        worker_does = gives_way();
        helper_does = helper_gives_way(1000);
    });
    CHECK(worker_does);
    CHECK(gives_way() == before);
    CHECK(helper_does == kHasHelpers);
}

TEST_CASE("give way: those who help in an arena do as who asked for it") {
    Worker worker([] {});
    bool helper_does = false;
    run(worker, [&] { helper_does = helper_in_arena_gives_way(1000); });
    CHECK(helper_does == kHasHelpers);
}

TEST_CASE("give way: what gives memory back is done on another thread, which does so") {
    const auto done = std::make_shared<std::promise<std::pair<std::thread::id, bool>>>();
    give_back_elsewhere([done] { done->set_value({std::this_thread::get_id(), gives_way()}); });
    const std::pair by = done->get_future().get();
    CHECK(by.first != std::this_thread::get_id());
    CHECK(by.second);
}
