// Paths along vessels: samples, tangents and frames against analytic curves, places against the tree.
#include "core/measure/tree_measure.h"
#include "core/slice/vessel_path.h"
#include "tests/core/slice/swept_tube.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace ramus;
using slice::VesselPath;

namespace {

VesselPath good_path(const Result<VesselPath>& path) {
    REQUIRE_MESSAGE(path, (path ? "" : path.error().message()));
    return *path;
}

void check_frames(const VesselPath& path) {
    const double facing = glm::dot(path.samples.front().axes.to_viewer(), path.samples.front().tangent);
    CHECK(std::abs(facing) == doctest::Approx(1.0));
    for (const auto& sample : path.samples) {
        CHECK(glm::length(sample.tangent) == doctest::Approx(1.0));
        CHECK(glm::length(sample.axes.right) == doctest::Approx(1.0));
        CHECK(std::abs(glm::dot(sample.axes.right, sample.axes.down)) < 1e-12);
        CHECK(std::abs(glm::dot(sample.axes.right, sample.tangent)) < 1e-12);
        CHECK(glm::dot(sample.axes.to_viewer(), sample.tangent) == doctest::Approx(facing));
    }
}

// Two ways from the stem to the end: branches 1 and 2 lead from one node to the same other node, 2 being shorter.
tree::VesselTree ring_tree() {
    return test::built_tree({{{0, 0, 0}, 1.0},
                             {{0, 0, 10}, 1.0},
                             {{5, 0, 20}, 1.0},
                             {{0, 0, 30}, 1.0},
                             {{-2, 0, 20}, 1.0},
                             {{0, 0, 40}, 1.0}},
                            {{0, 1}, {1, 2}, {2, 3}, {1, 4}, {4, 3}, {3, 5}});
}

} // namespace

TEST_CASE("frames along a helix are the rotation minimising ones of the analytic solution") {
    const test::Helix helix{20.0, 6.0};
    constexpr double kTurns = 4.0 * test::kPi;
    const auto tree = test::vessel_of([&](double t) { return helix.at(kTurns * t); }, 4001, 1.0);
    const VesselPath path = good_path(slice::path_of_branch(tree, 0, 0.25));
    CHECK(path.length_mm() == doctest::Approx(kTurns * helix.speed()).epsilon(1e-4));
    check_frames(path);
    // A rotation minimising frame turns against the Frenet frame by minus the torsion for each mm.
    const auto angle_to_frenet = [&](const slice::PathSample& sample) {
        const double angle = sample.arc_mm / helix.speed();
        const glm::dvec3 normal = test::Helix::normal(angle), binormal = glm::cross(helix.tangent(angle), normal);
        return std::atan2(glm::dot(sample.axes.right, binormal), glm::dot(sample.axes.right, normal));
    };
    const std::size_t first = path.nearest(5.0), last = path.nearest(path.length_mm() - 5.0);
    const double start = angle_to_frenet(path.samples[first]);
    for (std::size_t n = first; n <= last; n += 20) {
        const auto& sample = path.samples[n];
        const double angle = sample.arc_mm / helix.speed();
        CHECK(glm::distance(sample.at, helix.at(angle)) < 0.01);
        CHECK(glm::distance(sample.tangent, helix.tangent(angle)) < 2e-3);
        const double turned = start - helix.torsion() * (sample.arc_mm - path.samples[first].arc_mm);
        CHECK(std::abs(std::remainder(angle_to_frenet(sample) - turned, 2.0 * test::kPi)) < 0.005);
    }
}

TEST_CASE("samples are at equal steps, the last one at the end, with radii and places of the file") {
    const auto tree = test::built_tree({{{0, 0, 0}, 3.0}, {{0, 0, 12}, 1.0}, {{9, 0, 24}, 2.0}, {{-9, 0, 24}, 1.0}},
                                       {{0, 1}, {1, 2}, {1, 3}});
    const VesselPath path = good_path(slice::path_from_root(tree, 1, 0.4));
    REQUIRE(path.parts.size() == 2);
    CHECK(path.parts[0].branch == 0);
    CHECK(path.parts[1].branch == 1);
    CHECK(path.length_mm() == doctest::Approx(27.0).epsilon(1e-3));
    CHECK(path.step_mm <= 0.4);
    for (std::size_t n = 0; n < path.samples.size(); ++n) {
        const auto& sample = path.samples[n];
        CHECK(sample.arc_mm == doctest::Approx(path.step_mm * double(n)));
        const measure::BranchPoint point = measure::point_on(tree, sample.place);
        CHECK(glm::distance(point.position, sample.at) < 0.1); // the corner, cut by half a step
        CHECK(point.radius_mm == doctest::Approx(sample.radius_mm).epsilon(0.02));
        const auto arc = path.arc_of(sample.place);
        REQUIRE(arc);
        CHECK(std::abs(*arc - sample.arc_mm) < 1e-6);
    }
    CHECK(path.samples.back().at == tree.points[tree.branches[1].points.back()].position);
    // Places between samples, there and back.
    for (double arc = 0.0; arc < path.length_mm(); arc += 0.173) {
        const auto sample = path.at(arc);
        CHECK(sample.arc_mm == doctest::Approx(arc));
        CHECK(*path.arc_of(sample.place) == doctest::Approx(arc).epsilon(1e-6));
    }
    CHECK_FALSE(path.arc_of({2, 0.5}));
    check_frames(path);
}

TEST_CASE("a way between two places is the shortest one, through loops and against branches") {
    const auto tree = ring_tree();
    REQUIRE(tree.loop_count == 1);
    REQUIRE(tree.branches.size() == 4);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> fraction(0.0, 1.0);
    for (int from = 0; from < 4; ++from)
        for (int to = 0; to < 4; ++to)
            for (int repeat = 0; repeat < 6; ++repeat) {
                const measure::BranchPlace a{from, fraction(random)}, b{to, fraction(random)};
                const auto way = measure::path_between(tree, a, b);
                REQUIRE(way);
                const VesselPath path = good_path(slice::path_between(tree, a, b, 0.02));
                CHECK(path.length_mm() == doctest::Approx(way->length_mm).epsilon(0.002));
                CHECK(path.samples.front().place == a);
                CHECK(path.samples.back().place.branch == b.branch);
                CHECK(path.samples.back().place.fraction == doctest::Approx(b.fraction));
                for (const auto& place : way->places) {
                    double nearest = 1e9;
                    for (const auto& sample : path.samples)
                        nearest = std::min(nearest, glm::distance(sample.at, place));
                    CHECK(nearest < 0.02);
                }
            }
}

TEST_CASE("tangents do not wiggle with voxel steps, and positions stay within half a voxel") {
    // A line aslant on a grid of 0.8 mm, as thinning leaves it.
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 0.37, 0.21));
    std::vector<tree::Point> points;
    for (int n = 0; n <= 75; ++n) {
        const glm::dvec3 exact = 0.8 * n / direction.x * direction;
        points.push_back({0.8 * glm::round(exact / 0.8), 3.0});
    }
    auto tree = test::vessel_along(points);
    tree.voxels = tree::Voxels{0.8 * glm::dmat3(1.0), false};
    const VesselPath path = good_path(slice::path_of_branch(tree, 0));
    CHECK(path.step_mm == doctest::Approx(0.4).epsilon(0.01));
    double greatest = 0.0, at_ends = 0.0;
    for (const auto& sample : path.samples) {
        const double off = std::acos(glm::dot(sample.tangent, direction)) * 180.0 / test::kPi;
        const bool is_inner = sample.arc_mm > 4.5 && sample.arc_mm < path.length_mm() - 4.5;
        (is_inner ? greatest : at_ends) = std::max(is_inner ? greatest : at_ends, off);
        const double fraction = measure::nearest_fraction(tree, 0, sample.at);
        CHECK(glm::distance(measure::point_on(tree, 0, fraction).position, sample.at) <= 0.4);
    }
    CHECK(greatest < 4.0); // the file's own segments: up to 45 degrees
    CHECK(at_ends < 10.0);
    // The length is that of the line, not that of the stairs.
    CHECK(path.length_mm() == doctest::Approx(0.8 * 75 / direction.x).epsilon(0.02));
}

TEST_CASE("a way that cannot be is an error") {
    const auto tree = ring_tree();
    CHECK_FALSE(slice::path_of_branch(tree, 4));
    CHECK_FALSE(slice::path_of_branch(tree, -1));
    CHECK_FALSE(slice::path_from_root(tree, 17));
    CHECK_FALSE(slice::path_between(tree, {0, 0.5}, {9, 0.5}));
    CHECK_FALSE(slice::path_between(tree, {0, 0.5}, {0, 0.5}));
    CHECK_FALSE(slice::path_of_branch(tree, 0, -1.0));
    CHECK_FALSE(slice::path_of_branch(tree, 0, 1e-9));
    const auto apart = test::built_tree({{{0, 0, 0}, 1.0}, {{0, 0, 9}, 1.0}, {{50, 0, 0}, 1.0}, {{50, 0, 9}, 1.0}},
                                        {{0, 1}, {2, 3}}, {0, 2});
    REQUIRE(apart.branches.size() == 2);
    const auto none = slice::path_between(apart, {0, 0.5}, {1, 0.5});
    REQUIRE_FALSE(none);
    CHECK(none.error().what == "branches 0 and 1 are not connected");
}
