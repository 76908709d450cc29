// What is missing is made once, and what cannot be had is not tried again.
#include "app/workspace/background_work.h"

#include <atomic>
#include <chrono>
#include <doctest/doctest.h>
#include <stdexcept>
#include <thread>

using namespace ramus;
using namespace ramus::app;

namespace {

std::atomic<int> doubler_tries = 0; // of all works of this file

// Of 1, 2 and so on; 0 cannot be had, what is less ends by an exception, and 100 takes until it is cancelled.
Result<int> doubled(const int& wanted, Job& job) {
    ++doubler_tries;
    while (wanted == 100 && !job.cancelled()) std::this_thread::yield();
    if (wanted < 0) throw std::runtime_error("thrown");
    if (wanted == 0) return fail("there is no double of nothing");
    return 2 * wanted;
}

struct Doubler {
    std::vector<int> wanted; // the missing are those that have not been made
    std::vector<int> made;   // all results, in the order in which they came
    bool something_else_first = false;
    Document document;
    ReadySurface shown;
    Assets assets;
    std::deque<Error> errors;
    WorkOf<int, int> work;

    explicit Doubler(bool finishes = false)
        : work({}, {.kind = WorkKind::kCones,
                    .title = [](const int&) { return std::string("Doubling"); },
                    .missing =
                        [this](const WorkView&, const Assets&) {
                            std::vector<int> missing;
                            for (const int one : wanted)
                                if (std::ranges::find(made, 2 * one) == made.end()) missing.push_back(one);
                            return missing;
                        },
                    .make = doubled,
                    .put = [this](const int&, const int& result, Assets&) { made.push_back(result); },
                    .waits = [this](const WorkView&) { return something_else_first; },
                    .finishes = finishes}) {
        doubler_tries = 0;
    }
    [[nodiscard]] WorkView view() const { return {.document = document, .request = {}, .shown = shown}; }
    bool follow() { return work.follow(view(), assets, errors); }
    [[nodiscard]] bool awaited() const { return work.awaited(view(), assets); }
    void finish() {
        for (follow(); work.worker().busy(); follow()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
};

} // namespace

TEST_CASE("missing results are computed one after the other, when no other work has priority") {
    Doubler doubler;
    CHECK_FALSE(doubler.follow());
    doubler.wanted = {4, 3};
    doubler.something_else_first = true;
    doubler.follow();
    CHECK_FALSE(doubler.work.worker().busy());
    CHECK(doubler.awaited());
    doubler.something_else_first = false;
    doubler.follow();
    CHECK(doubler.work.worker().title() == "Doubling");
    doubler.finish();
    CHECK(doubler.made == std::vector{8, 6});
    CHECK(doubler_tries == 2);
    CHECK_FALSE(doubler.awaited());
}

TEST_CASE("work that is no longer needed is dropped, or finished if so configured") {
    Doubler doubler;
    doubler.wanted = {100}; // goes on until something else is wanted
    doubler.follow();
    doubler.follow();
    doubler.wanted = {5};
    doubler.follow();
    doubler.finish();
    CHECK(doubler.made == std::vector{10});
    doubler.wanted = {6};
    doubler.follow();
    doubler.wanted = {};
    doubler.work.forget();
    doubler.finish();
    CHECK(doubler.made == std::vector{10});

    Doubler finishing(true);
    finishing.wanted = {1};
    finishing.follow();
    finishing.wanted = {2};
    finishing.finish();
    CHECK(finishing.made == std::vector{2, 4});
}

TEST_CASE("failed work is not repeated while its result is needed, unless requested") {
    Doubler doubler;
    doubler.wanted = {0, 7};
    doubler.finish();
    CHECK(doubler.made == std::vector{14}); // what fails holds up nothing else
    CHECK(doubler.work.problem() == "there is no double of nothing");
    CHECK_FALSE(doubler.awaited());
    doubler.follow();
    CHECK(doubler_tries == 2);
    doubler.work.retry();
    CHECK(doubler.work.problem().empty());
    doubler.finish();
    CHECK(doubler_tries == 3);
    doubler.wanted = {};
    doubler.follow();
    CHECK(doubler.work.problem().empty());

    doubler.wanted = {100};
    doubler.follow();
    doubler.work.cancel(doubler.assets);
    CHECK(doubler.work.problem() == "cancelled");
    CHECK(doubler.follow());
    CHECK_FALSE(doubler.work.worker().busy());
    CHECK_FALSE(doubler.awaited());
}

TEST_CASE("an exception ends the work with an error, not the program") {
    Doubler doubler;
    doubler.wanted = {-1};
    doubler.finish();
    REQUIRE(doubler.errors.size() == 1);
    CHECK(doubler.errors.front().what == "the work was given up: thrown");
    CHECK(doubler.work.problem() == "the work was given up: thrown");
    doubler.follow();
    CHECK(doubler.errors.size() == 1);
}
