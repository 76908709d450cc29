#include "core/base/own_process.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <stdexcept>
#include <vector>

using namespace ramus;

TEST_CASE("work in a process of its own hands back bytes of any kind and length") {
    std::string large(3'000'000, 'x');
    large[17] = '\0';
    const auto answer = run_in_own_process([&] { return large; }, {});
    REQUIRE(answer);
    CHECK(*answer == large);
    const auto nothing = run_in_own_process([] { return std::string(); }, {});
    REQUIRE(nothing);
    CHECK(nothing->empty());
}

TEST_CASE("what happens in a process of its own stays there") {
    int touched = 0;
    REQUIRE(run_in_own_process(
        [&] {
            ++touched;
            return std::string("done");
        },
        {}));
    CHECK(touched == 0);
    CHECK_FALSE(run_in_own_process([]() -> std::string { std::abort(); }, {}));
    CHECK_FALSE(run_in_own_process([]() -> std::string { throw std::runtime_error("no"); }, {}));
    CHECK_FALSE(run_in_own_process([]() -> std::string { std::_Exit(0); }, {})); // an end without an answer
}

TEST_CASE("limits of time, memory and length hold in a process of its own") {
    ProcessLimits limits{.memory = 64U << 20, .seconds = 1, .answer = 1000};
    CHECK_FALSE(run_in_own_process(
        []() -> std::string {
            volatile bool forever = true;
            while (forever) {
            }
            return {};
        },
        limits));
    CHECK_FALSE(run_in_own_process([] { return std::string(1001, 'x'); }, limits));
    CHECK(run_in_own_process([] { return std::string(900, 'x'); }, limits));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they end the process in their own way
    CHECK_FALSE(run_in_own_process(
        [] {
            const std::vector<char> much(std::size_t{1} << 30, 'x');
            return std::string(1, much.back());
        },
        limits));
#endif
}
