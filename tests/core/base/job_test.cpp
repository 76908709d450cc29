#include "core/base/job.h"

#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("job: a step's progress is its part of the whole, and it is cancelled with it") {
    Job whole;
    Job first(whole, 0.0F, 0.25F), second(whole, 0.25F, 1.0F);
    first.report(0.5F);
    CHECK(whole.progress() == doctest::Approx(0.125));
    Job within(second, 0.5F, 1.0F); // of a step
    within.report(0.5F);
    CHECK(second.progress() == doctest::Approx(0.75));
    CHECK(whole.progress() == doctest::Approx(0.25 + 0.75 * 0.75));
    first.cancel();
    CHECK(first.cancelled());
    CHECK_FALSE(whole.cancelled());
    CHECK_FALSE(within.cancelled());
    whole.cancel();
    CHECK(second.cancelled());
    CHECK(within.cancelled());
}
