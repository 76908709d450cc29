#include "core/base/numbered_set.h"

#include <doctest/doctest.h>
#include <random>
#include <set>

using namespace ramus;

TEST_CASE("a set of numbers lists them in order and knows the place of each") {
    std::mt19937 random(5);
    for (const std::uint32_t limit : {1U, 63U, 64U, 65U, 5000U}) {
        CAPTURE(limit);
        NumberedSet numbers(limit);
        std::set<std::uint32_t> expected;
        for (std::uint32_t n = 0; n < limit; ++n) {
            const auto number = static_cast<std::uint32_t>(random() % limit);
            CHECK(numbers.add(number) == expected.insert(number).second);
        }
        const std::vector<std::uint32_t> listed = numbers.list();
        CHECK(listed == std::vector<std::uint32_t>(expected.begin(), expected.end()));
        for (std::uint32_t place = 0; place < listed.size(); ++place) CHECK(numbers.place(listed[place]) == place);
    }
    CHECK(NumberedSet(0).list().empty());
}
