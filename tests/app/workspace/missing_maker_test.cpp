// What is missing is made once, and what cannot be had is not tried again.
#include "app/workspace/missing_maker.h"

#include <atomic>
#include <chrono>
#include <doctest/doctest.h>
#include <stdexcept>
#include <thread>

using namespace ramus;
using namespace ramus::app;

namespace {

using Doubler = MissingMaker<int, int>;

std::atomic<int> doubler_tries = 0; // of all makers of this file

// Of 1, 2 and so on; 0 cannot be had, what is less ends by an exception, and 100 takes until it is cancelled.
Result<int> doubled(const int& wanted, Job& job) {
    ++doubler_tries;
    while (wanted == 100 && !job.cancelled()) std::this_thread::yield();
    if (wanted < 0) throw std::runtime_error("thrown");
    if (wanted == 0) return fail("there is no double of nothing");
    return 2 * wanted;
}

void finish_making(Doubler& maker) {
    while (maker.worker().busy()) {
        maker.drain();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

} // namespace

TEST_CASE("what is missing is made when nothing else comes first, and told once") {
    doubler_tries = 0;
    Doubler maker({}, "Doubling", doubled);
    maker.follow(std::nullopt, false);
    maker.follow(4, true);
    CHECK_FALSE(maker.worker().busy());
    CHECK(maker.awaits(4));
    maker.follow(4, false);
    CHECK(maker.worker().title() == "Doubling");
    finish_making(maker);
    CHECK(maker.take_news() == 8);
    CHECK_FALSE(maker.take_news());
    CHECK(doubler_tries == 1);
    maker.follow(100, false); // goes on until something else is wanted
    maker.follow(100, false);
    maker.follow(5, false);
    maker.follow(5, false);
    finish_making(maker);
    CHECK(maker.take_news() == 10);
    maker.follow(6, false);
    maker.forget();
    finish_making(maker);
    CHECK_FALSE(maker.take_news());
}

TEST_CASE("what cannot be had is not tried again while it is wanted, unless somebody asks") {
    doubler_tries = 0;
    Doubler maker({}, "Doubling", doubled);
    maker.follow(0, false);
    finish_making(maker);
    CHECK_FALSE(maker.take_news());
    CHECK(maker.failed() == 0);
    CHECK(maker.problem() == "there is no double of nothing");
    CHECK_FALSE(maker.awaits(0));
    maker.follow(0, false);
    CHECK_FALSE(maker.worker().busy());
    CHECK(doubler_tries == 1);
    maker.retry();
    CHECK(maker.problem().empty());
    maker.follow(0, false);
    finish_making(maker);
    CHECK(doubler_tries == 2);
    maker.follow(7, false);
    CHECK_FALSE(maker.failed());
    finish_making(maker);
    CHECK(maker.take_news() == 14);

    maker.follow(100, false);
    maker.cancel();
    CHECK(maker.failed() == 100);
    CHECK(maker.problem() == "cancelled");
    maker.follow(100, false);
    CHECK_FALSE(maker.worker().busy());
    maker.follow(-1, false);
    finish_making(maker);
    CHECK(maker.take_failure() == "thrown");
    CHECK(maker.failed() == -1);
    CHECK(maker.problem() == "the work was given up: thrown");
    CHECK(maker.take_failure().empty());
}
