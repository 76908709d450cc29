// A thread that draws: what it does, in which order, and what who asks may count on.
#include "app/window/drawing_thread.h"

#include <atomic>
#include <doctest/doctest.h>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using ramus::app::DrawingThread;

namespace {

constexpr double kForEver = 60.0; // seconds; nothing here takes as long

struct Told {
    std::atomic<int> entered{0}, left{0}, woken{0};
    std::thread::id who;
};

std::unique_ptr<DrawingThread> thread_of(Told& told, bool can = true) {
    return std::make_unique<DrawingThread>(
        [&told, can] {
            told.who = std::this_thread::get_id();
            ++told.entered;
            return can;
        },
        [&told] { ++told.left; }, [&told] { ++told.woken; });
}

// Holds the thread until it is let go.
class Held {
public:
    explicit Held(DrawingThread& thread) {
        thread.post([gate = gate_.get_future().share()] { gate.wait(); });
    }
    ~Held() { gate_.set_value(); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

private:
    std::promise<void> gate_;
};

} // namespace

TEST_CASE("without a thread what is asked for is done at once, by who asks") {
    DrawingThread none;
    CHECK_FALSE(none.has_thread());
    auto who = none.begin([] { return std::this_thread::get_id(); });
    CHECK(none.idle());
    REQUIRE(none.done(who, 0.0));
    CHECK(who.get() == std::this_thread::get_id());
}

TEST_CASE("a thread that gets no context is none") {
    Told told;
    {
        const auto thread = thread_of(told, false);
        CHECK_FALSE(thread->has_thread());
        CHECK(thread->run([] { return std::this_thread::get_id(); }) == std::this_thread::get_id());
    }
    CHECK(told.entered == 1);
    CHECK(told.left == 0);
}

TEST_CASE("a drawing thread does one thing after the other, all of it, between the first and the last") {
    Told told;
    std::vector<int> done;
    {
        const auto thread = thread_of(told);
        REQUIRE(thread->has_thread());
        CHECK(thread->run([] { return std::this_thread::get_id(); }) == told.who);
        const Held held(*thread);
        for (int i = 0; i < 20; ++i)
            thread->post([&done, &told, i] {
                CHECK(told.left == 0);
                done.push_back(i);
            });
        CHECK_FALSE(thread->idle());
    }
    CHECK(told.left == 1);
    REQUIRE(done.size() == 20);
    for (int i = 0; i < 20; ++i) CHECK(done[static_cast<std::size_t>(i)] == i);
}

TEST_CASE("what work throws comes to who asked, and the thread goes on") {
    Told told;
    const auto thread = thread_of(told);
    CHECK_THROWS_AS(thread->run([]() -> int { throw std::runtime_error("no memory"); }), std::runtime_error);
    CHECK(thread->idle());
    CHECK(thread->run([] { return 7; }) == 7);
}

TEST_CASE("what work holds is let go, and the thread idle, before its result is known") {
    Told told;
    const auto thread = thread_of(told);
    for (int i = 0; i < 200; ++i) {
        auto large = std::make_shared<int>(i);
        const std::weak_ptr<int> watched = large;
        auto result = thread->begin([large = std::move(large)] { return *large; });
        REQUIRE(result.get() == i);
        CHECK(watched.expired());
        CHECK(thread->idle());
    }
}

TEST_CASE("the window is woken for a result that it looked for in vain, and for no other") {
    Told told;
    const auto thread = thread_of(told);
    CHECK(thread->run([] { return 1; }) == 1);
    CHECK(told.woken == 0);
    std::future<int> late;
    {
        const Held held(*thread);
        late = thread->begin([] { return 2; });
        CHECK_FALSE(thread->done(late, 0.0));
        CHECK(told.woken == 0);
    }
    CHECK(thread->done(late, kForEver));
    CHECK(late.get() == 2);
    while (told.woken == 0) std::this_thread::yield();
    thread->run([] {});
    CHECK(told.woken == 1);
}

TEST_CASE("what is asked for later is looked at without waiting, and who waits for other work is counted") {
    Told told;
    const auto thread = thread_of(told);
    CHECK(thread->run([] { return 1; }) == 1);
    CHECK(thread->waits() == 0); // for nothing but its own
    ramus::app::Deferred<int> coming;
    {
        const Held held(*thread);
        coming = thread->later([] { return 3; });
        CHECK_FALSE(coming.ready());
    }
    while (!coming.ready()) std::this_thread::yield();
    std::atomic<int> taken{0};
    std::thread elsewhere([&] { taken = coming.take(); });
    elsewhere.join();
    CHECK(taken == 3);
    std::promise<void> gate;
    thread->post([shut = gate.get_future().share()] { shut.wait(); });
    struct Opens { // when it is handed over, which is after run() has looked
        explicit Opens(std::promise<void>& its) : gate(&its) {}
        Opens(Opens&& other) noexcept {
            if (other.gate != nullptr) other.gate->set_value();
        }
        void operator()() const {}
        std::promise<void>* gate = nullptr;
    };
    thread->run(Opens(gate));
    CHECK(thread->waits() == 1);
}
