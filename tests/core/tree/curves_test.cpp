#include "core/mesh/tree_field.h"
#include "core/tree/curves.h"
#include "tests/support/built_tree.h"
#include "tests/support/grown_tree.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>

using namespace ramus;
using tree::Point;

namespace {

tree::PreparedTree prepared_run(const std::vector<Point>& points) {
    tree::PreparedTree prepared;
    test::add_branch(prepared, points);
    return prepared;
}

std::vector<Point> along(const std::vector<Point>& points) {
    const tree::PreparedTree lines = prepared_run(points);
    const tree::PreparedTree curves = tree::along_curves(lines, tree::pieces_of_curves(lines.tree));
    REQUIRE(curves.segment_source.size() == curves.tree.segment_count());
    std::vector<Point> found;
    for (const std::uint32_t p : curves.tree.branches[0].points) found.push_back(curves.tree.points[p]);
    return found;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b) / (glm::length(a) * glm::length(b)), -1.0, 1.0)) * 180.0 /
           std::numbers::pi;
}

double distance_to_line(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double share = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + share * (b - a));
}

} // namespace

TEST_CASE("what is straight, and what the kernel rounds by itself, stays as it is") {
    std::vector<Point> straight, stairs;
    for (int n = 0; n <= 20; ++n) straight.push_back({{0.5 * n, 0.0, 0.0}, 1.0 + 0.01 * n});
    glm::dvec3 step(0.0);
    for (int n = 0; n <= 20; ++n) {
        stairs.push_back({step, 1.0});
        step[n % 2] += 0.2;
    }
    for (const auto& points : {straight, stairs}) {
        const std::vector<Point> found = along(points);
        REQUIRE(found.size() == points.size());
        for (std::size_t n = 0; n < points.size(); ++n) CHECK(found[n].position == points[n].position);
    }
}

TEST_CASE("corners are rounded near their points, within the hull, and radii between those of the points") {
    for (const double turn : {20.0, 45.0, 90.0, 140.0}) {
        CAPTURE(turn);
        const double angle = turn * std::numbers::pi / 180.0;
        const std::vector<Point> points{
            {{0, 0, 0}, 1.0}, {{6, 0, 0}, 0.5}, {{6 + 4 * std::cos(angle), 4 * std::sin(angle), 0}, 1.2}};
        const std::vector<Point> found = along(points);
        REQUIRE(found.size() > 3);
        CHECK(found.front().position == points.front().position);
        CHECK(found.back().position == points.back().position);
        // Half a corner has a piece for each 45 degrees, three at most. A parabola turns most in the middle, there
        // by 2.5 times its mean at most.
        const double turns = 2.0 * std::min(std::ceil(turn / 45.0), 3.0) + 1.0;
        for (std::size_t n = 2; n < found.size(); ++n)
            CHECK(degrees_between(found[n - 1].position - found[n - 2].position,
                                  found[n].position - found[n - 1].position) <= 2.5 * turn / turns);
        double nearest = 1e300, thinnest = 1e300;
        for (const Point& p : found) {
            nearest = std::min(nearest, glm::distance(p.position, points[1].position));
            thinnest = std::min(thinnest, p.radius);
            // The curve's distance from the corner is a half of that of the chord.
            CHECK(std::min(distance_to_line(p.position, points[0].position, points[1].position),
                           distance_to_line(p.position, points[1].position, points[2].position)) <= 0.25);
            CHECK(p.radius <= 1.2);
        }
        CHECK(nearest <= 0.5 * 0.5 * std::sin(0.5 * angle) + 1e-9); // reach: the radius there
        CHECK(thinnest == 0.5);                                     // a narrow place keeps its radius
    }
}

TEST_CASE("corners that meet half-way have no piece between them") {
    std::vector<Point> points;
    glm::dvec3 at(0.0);
    for (int n = 0; n < 5; ++n) { // corners that turn by 40 degrees, to and fro
        points.push_back({at, 1.0});
        const double angle = n % 2 == 0 ? 0.0 : 40.0 * std::numbers::pi / 180.0;
        at += 1.5 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
    }
    const std::vector<Point> found = along(points);
    CHECK(found.size() == 2 * points.size() - 1);
    for (std::size_t n = 1; n < found.size(); ++n) CHECK(glm::distance(found[n - 1].position, found[n].position) > 0.5);
}

TEST_CASE("what is not pruned keeps its number and its place on the curves") {
    const tree::VesselTree tree = test::grown(60);
    mesh::SurfaceOptions options;
    const tree::PreparedTree whole = mesh::prepare_tree(tree, options);
    options.prune_ratio = 1.5;
    const tree::PreparedTree pruned = mesh::prepare_tree(tree, options);
    REQUIRE(pruned.segment_index.size() < whole.segment_source.size());
    REQUIRE(pruned.source_segments == whole.segment_source.size());
    std::vector<Point> begins;
    for (const tree::Branch& branch : whole.tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n)
            begins.push_back(whole.tree.points[branch.points[n - 1]]);
    std::size_t segment = 0, same = 0;
    for (const tree::Branch& branch : pruned.tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n, ++segment) {
            const std::uint32_t index = pruned.segment_index[segment];
            REQUIRE(index < begins.size());
            CHECK(pruned.segment_source[segment] == whole.segment_source[index]);
            same += pruned.tree.points[branch.points[n - 1]].position == begins[index].position ? 1 : 0;
        }
    CHECK(same > segment / 2);
}
