// Lines of equal distance in a plane.
#include "core/slice/level_lines.h"

#include <array>
#include <atomic>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;

TEST_SUITE("slice") {
    TEST_CASE("lines of equal distance from a ball are circles, and most of the plane is not asked for") {
        const glm::dvec3 centre(4.0, -3.0, 20.0);
        const slice::PixelGrid grid = slice::grid_around(slice::axes_across({1.0, 2.0, 3.0}), centre, 1.0, {301, 257});
        std::atomic<int> asked = 0;
        const auto distance = [&](const glm::dvec3& at) {
            ++asked;
            return glm::distance(at, centre) - 10.0;
        };
        const std::array levels{5.0, 20.0, 130.0};
        const auto lines = slice::level_lines(grid, levels, distance);
        REQUIRE(lines.size() == 3);
        for (std::size_t n = 0; n < 2; ++n) {
            REQUIRE(lines[n].size() == 1);
            CHECK(lines[n].front().closed);
            double length = 0.0;
            const auto& points = lines[n].front().points;
            for (std::size_t k = 0; k < points.size(); ++k) {
                CHECK(std::abs(glm::distance(points[k].at, centre) - 10.0 - levels[n]) < 0.02);
                length += glm::distance(points[k].at, points[(k + 1) % points.size()].at);
            }
            CHECK(length == doctest::Approx(2.0 * 3.14159265 * (10.0 + levels[n])).epsilon(0.002));
        }
        // A circle of 140 mm leaves the grid above and below.
        CHECK(lines[2].size() == 2);
        for (const slice::Loop& loop : lines[2]) CHECK_FALSE(loop.closed);
        CHECK(asked < 301 * 257 / 3);
    }

    TEST_CASE("a grid without cells has no lines") {
        const std::array levels{0.0};
        const auto lines = slice::level_lines({}, levels, [](const glm::dvec3& at) { return at.x; });
        REQUIRE(lines.size() == 1);
        CHECK(lines.front().empty());
    }
}
