// Radii that are interpolated: linear along a vessel, harmonic where vessels without radii fork.
#include "core/tree/missing_radii.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

tree::Point point_at(double x, double y, double radius) { return {{x, y, 0.0}, radius}; }

} // namespace

TEST_CASE("between two measured points radii are linear in the arc length, also around corners") {
    std::vector<tree::Point> points = {point_at(0, 0, 4.0), point_at(3, 0, 0.0), point_at(3, 5, tree::kNotMeasured),
                                       point_at(3, 8, 1.0), point_at(9, 8, 0.0)};
    const auto filled = tree::fill_missing_radii(points, {{0, 1}, {2, 1}, {2, 3}, {3, 4}});
    CHECK(filled.points == std::vector<std::uint32_t>{1, 2, 4});
    CHECK_FALSE(filled.out_of_reach);
    CHECK(points[1].radius == doctest::Approx(4.0 - 3.0 * 3.0 / 11.0));
    CHECK(points[2].radius == doctest::Approx(4.0 - 3.0 * 8.0 / 11.0));
    CHECK(points[4].radius == doctest::Approx(1.0)); // beyond the last measured point
}

TEST_CASE("where vessels without radii fork, what flows in flows out") {
    // Two forks in a row: every value is the mean of those around, weighted by one over the length.
    std::vector<tree::Point> points = {point_at(0, 0, 5.0),  point_at(4, 0, 0.0),  point_at(4, 2, 3.0),
                                       point_at(9, 0, 0.0),  point_at(9, 1, 2.0),  point_at(17, 0, 1.0),
                                       point_at(9, -3, 0.0), point_at(12, -3, 0.0)};
    const std::vector<tree::Edge> edges = {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}, {3, 6}, {6, 7}};
    const auto filled = tree::fill_missing_radii(points, edges);
    CHECK(filled.points.size() == 4);
    for (const std::uint32_t p : filled.points) {
        double balance = 0.0;
        for (const auto& [a, b] : edges)
            if (a == p || b == p)
                balance += (points[a == p ? b : a].radius - points[p].radius) /
                           glm::distance(points[a].position, points[b].position);
        CHECK(std::abs(balance) < 1e-12);
    }
}

TEST_CASE("loops without radii get radii between the least and the largest measured one") {
    std::vector<tree::Point> points = {point_at(0, 0, 5.0),  point_at(1, 0, 0.0), point_at(2, 1, 0.0),
                                       point_at(2, -1, 0.0), point_at(3, 0, 0.0), point_at(4, 0, 1.0)};
    const auto filled = tree::fill_missing_radii(points, {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 5}});
    CHECK(filled.points.size() == 4);
    for (const tree::Point& point : points) CHECK((point.radius >= 1.0 && point.radius <= 5.0));
}

TEST_CASE("a vessel without any radius is named; points too near for a division are no danger") {
    std::vector<tree::Point> points = {point_at(0, 0, 5.0), point_at(1, 0, 0.0), point_at(9, 0, 0.0),
                                       point_at(9, 1, 0.0)};
    const auto filled = tree::fill_missing_radii(points, {{0, 1}, {2, 3}});
    REQUIRE(filled.out_of_reach);
    CHECK(*filled.out_of_reach == 2);
    std::vector<tree::Point> near = {point_at(0, 0, 5.0), point_at(5e-324, 0, 0.0), point_at(1e-300, 0, 0.0),
                                     point_at(1, 0, 3.0)};
    CHECK_FALSE(tree::fill_missing_radii(near, {{0, 1}, {1, 2}, {2, 3}}).out_of_reach);
    for (const tree::Point& point : near) CHECK((point.radius >= 3.0 && point.radius <= 5.0));
}
