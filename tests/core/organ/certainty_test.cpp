#include "core/organ/certainty.h"

#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("territories are the surer, the more branches are visible and the fewer territories there are") {
    CHECK_FALSE(organ::expected_certainty(59, 2));
    CHECK_FALSE(organ::expected_certainty(300, 1));
    CHECK_FALSE(organ::expected_certainty(300, 9));
    for (std::size_t parts = 2; parts <= 8; ++parts)
        for (std::size_t visible = 60; visible < 1000; ++visible) {
            const auto here = organ::expected_certainty(visible, parts),
                       more = organ::expected_certainty(visible + 1, parts);
            REQUIRE(here);
            REQUIRE(more);
            CHECK(more->dice > here->dice);
            CHECK(more->error_percent < here->error_percent);
            if (parts == 8) continue;
            const auto finer = organ::expected_certainty(visible, parts + 1);
            CHECK(finer->dice < here->dice);
            CHECK(finer->error_percent > here->error_percent);
        }
    CHECK(organ::expected_certainty(5000, 3)->dice == organ::expected_certainty(1000, 3)->dice);
    // 548 is the geometric mean of 300 and 1,000.
    const double low = organ::expected_certainty(300, 4)->dice, high = organ::expected_certainty(1000, 4)->dice;
    CHECK(organ::expected_certainty(548, 4)->dice == doctest::Approx(0.5 * (low + high)).epsilon(1e-3));
}
