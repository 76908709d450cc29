#include "core/measure/branch_point.h"
#include "core/measure/cuts.h"
#include "core/measure/tree_measure.h"
#include "core/tree/network.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

using namespace ramus;
using measure::Amount;
using measure::Cut;
using test::built_tree;
using tree::VesselTree;

namespace {

// A stem of 10 mm, r 3, along z; at its end two branches: 8 mm along x, r 2, and 6 mm along y, r 1; at the end of the
// first two more of 5 mm, r 1.
VesselTree small_tree() {
    return built_tree(
        {{{0, 0, 0}, 3}, {{0, 0, 10}, 3}, {{8, 0, 10}, 3}, {{0, 6, 10}, 3}, {{8, 0, 15}, 3}, {{8, 5, 10}, 3}},
        {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {2, 5}});
}

struct Known {
    explicit Known(VesselTree t)
        : tree(std::move(t)), dependency(tree), statistics(measure::tree_statistics(tree)),
          dependents(measure::dependent_amounts(tree, statistics, dependency)) {}
    [[nodiscard]] measure::CutReport report(std::vector<Cut> cuts, double limit = 5.0) const {
        return measure::cut_report(tree, dependency, dependents, cuts, limit);
    }
    VesselTree tree;
    tree::Dependency dependency;
    measure::TreeStatistics statistics;
    std::vector<Amount> dependents;
};

double cylinder(double r, double length) { return std::numbers::pi * r * r * length; }

} // namespace

TEST_CASE("places along a branch go by length, radii are linear between points") {
    const VesselTree tree = built_tree({{{0, 0, 0}, 4}, {{0, 0, 6}, 1}, {{0, 2, 6}, 2}}, {{0, 1}, {1, 2}});
    REQUIRE(tree.branches.size() == 1);
    const auto middle = measure::point_on(tree, 0, 0.5); // 4 of 8 mm
    CHECK(middle.position.z == doctest::Approx(4.0));
    CHECK(middle.radius_mm == doctest::Approx(2.0));
    CHECK(middle.direction == glm::dvec3(0.0, 0.0, 1.0));
    const auto late = measure::point_on(tree, 0, 0.875); // 7 mm: half of the second segment
    CHECK(late.position.y == doctest::Approx(1.0));
    CHECK(late.radius_mm == doctest::Approx(1.5));
    CHECK(late.direction.y == doctest::Approx(1.0));
    CHECK(measure::point_on(tree, 0, -1.0).position == glm::dvec3(0.0));
    CHECK(measure::point_on(tree, 0, 9.0).radius_mm == doctest::Approx(2.0));

    // The part from 2 to 7 mm: cones of radii 3 to 1 over 4 mm and 1 to 1.5 over 1 mm.
    const auto part = measure::part_of(tree, 0, 0.25, 0.875);
    CHECK(part.length_mm == doctest::Approx(5.0));
    CHECK(part.volume_mm3 == doctest::Approx(std::numbers::pi / 3.0 * (4.0 * (9 + 3 + 1) + 1.0 * (1 + 1.5 + 2.25))));
    CHECK(measure::part_of(tree, 0, 0.5, 0.5).length_mm == 0.0);
    const auto whole = measure::part_of(tree, 0, 0.0, 1.0);
    CHECK(whole.volume_mm3 == doctest::Approx(measure::tree_statistics(tree).volume_mm3));
}

TEST_CASE("a cut costs the rest of its branch and all that depends on it") {
    const Known known(small_tree());
    REQUIRE(known.tree.branches.size() == 5);
    const auto report = known.report({{1, 0.25}});
    REQUIRE(report.cuts.size() == 1);
    CHECK(report.cuts[0].diameter_mm == doctest::Approx(6.0));
    CHECK(report.cuts[0].reconstruct);
    const Amount& lost = report.cuts[0].lost;
    CHECK(lost.branches == 3);
    CHECK(lost.length_mm == doctest::Approx(6.0 + 5.0 + 5.0));
    CHECK(lost.volume_mm3 == doctest::Approx(cylinder(3.0, 16.0)));
    CHECK(lost.leaves == 2);
    CHECK(report.together == lost);
    CHECK(report.in_part == 1);
    CHECK(report.spans[1] == measure::LostSpan{0.25, 1.0});
    CHECK(report.spans[3].whole());
    CHECK_FALSE(report.spans[0].any());
    CHECK_FALSE(known.report({{1, 0.25}}, 6.0).cuts[0].reconstruct); // larger than, not as large as
}

TEST_CASE("cuts that nest count nothing twice") {
    const Known known(small_tree());
    const auto report = known.report({{3, 0.5}, {1, 0.5}, {1, 0.75}, {2, 1.0}});
    CHECK(report.cuts[0].lost.length_mm == doctest::Approx(2.5));
    CHECK(report.cuts[1].lost.length_mm == doctest::Approx(14.0));
    CHECK(report.cuts[3].lost == Amount{});
    CHECK(report.together.branches == 3);
    CHECK(report.together.length_mm == doctest::Approx(14.0));
    CHECK(report.together.leaves == 2);
    CHECK(report.spans[1] == measure::LostSpan{0.5, 1.0});
    CHECK(known.report({}).spans.empty());
    CHECK(known.report({{0, 0.0}}).together.length_mm == doctest::Approx(known.statistics.length_mm));
}

TEST_CASE("on a loop one cut loses nothing, two lose what lies between them") {
    // A stem, a square of four corners with a twig at the far one: 0-1, 1-2-4 and 1-3-4, 4-5.
    const Known known(built_tree(
        {{{0, 0, -5}, 1}, {{0, 0, 0}, 1}, {{10, 0, 0}, 1}, {{0, 10, 0}, 1}, {{10, 10, 0}, 1}, {{15, 15, 0}, 1}},
        {{0, 1}, {1, 2}, {2, 4}, {1, 3}, {3, 4}, {4, 5}}));
    REQUIRE(known.tree.branches.size() == 4);
    const auto one = known.report({{1, 0.5}});
    CHECK(one.cuts[0].lost == Amount{});
    CHECK(one.together == Amount{});
    CHECK_FALSE(one.spans[1].any());
    const auto both = known.report({{1, 0.5}, {2, 0.25}});
    CHECK(both.cuts[0].lost == Amount{});
    CHECK(both.together.branches == 3);
    CHECK(both.together.length_mm == doctest::Approx(10.0 + 15.0 + std::sqrt(50.0)));
    CHECK(both.together.leaves == 1);
    const auto same = known.report({{1, 0.25}, {1, 0.75}}); // what lies between two cuts of one way
    CHECK(same.together.branches == 1);
    CHECK(same.together.length_mm == doctest::Approx(10.0));
    CHECK(same.spans[1] == measure::LostSpan{0.25, 0.75});
    const auto beyond = known.report({{0, 0.5}, {2, 0.5}}); // a stem's cut takes all behind it
    CHECK(beyond.together.length_mm == doctest::Approx(known.statistics.length_mm - 2.5));
}

TEST_CASE("losses agree with sampling the network, for networks and cuts at random") {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(0.0, 50.0), share(0.0, 1.0);
    for (int round = 0; round < 60; ++round) {
        const std::uint32_t count = 3 + random() % 14;
        std::vector<tree::Point> points;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::uint32_t i = 0; i < count; ++i) {
            points.push_back({{place(random), place(random), place(random)}, 0.5 + share(random)});
            if (i > 0) edges.emplace_back(random() % i, i);
        }
        for (std::uint32_t i = 0; i < random() % 5; ++i) {
            const std::uint32_t a = random() % count, b = random() % count;
            if (a != b) edges.emplace_back(a, b);
        }
        const Known known(built_tree(std::move(points), std::move(edges)));
        std::vector<Cut> cuts;
        for (std::uint32_t i = 0; i < 1 + random() % 4; ++i)
            cuts.emplace_back(random() % known.tree.branches.size(), share(random));
        const auto report = known.report(cuts);
        // Every branch as pieces between its cuts; a piece is reached when it begins or ends at a reached node.
        const tree::Network network(known.tree);
        const std::size_t branches = known.tree.branches.size();
        std::vector<std::vector<double>> at(branches);
        for (const auto& [b, f] : cuts) at[static_cast<std::size_t>(b)].push_back(f);
        std::vector<char> reached(static_cast<std::size_t>(network.node_count()), 0);
        for (const int root : network.roots) reached[static_cast<std::size_t>(root)] = 1;
        for (bool more = true; more;) {
            more = false;
            for (std::size_t b = 0; b < branches; ++b) {
                const auto [s, e] = network.ends[b];
                char &x = reached[static_cast<std::size_t>(s)], &y = reached[static_cast<std::size_t>(e)];
                if (!at[b].empty() || x == y) continue;
                x = y = 1;
                more = true;
            }
        }
        for (std::size_t b = 0; b < branches; ++b) {
            std::ranges::sort(at[b]);
            for (int sample = 0; sample < 20; ++sample) {
                const double f = (sample + 0.5) / 20.0;
                const bool from_start =
                    reached[static_cast<std::size_t>(network.ends[b][0])] != 0 && (at[b].empty() || f < at[b].front());
                const bool from_end =
                    reached[static_cast<std::size_t>(network.ends[b][1])] != 0 && (at[b].empty() || f > at[b].back());
                const measure::LostSpan& span = report.spans[b];
                CHECK((f > span.from && f < span.to) == !(from_start || from_end));
            }
        }
        // What one cut loses by itself is part of what all lose.
        for (const auto& figures : report.cuts) CHECK(figures.lost.length_mm <= report.together.length_mm + 1e-9);
        if (cuts.size() == 1) CHECK(report.cuts[0].lost.length_mm == doctest::Approx(report.together.length_mm));
    }
}

TEST_CASE("paths go along centerlines from place to place, and take the shorter way round") {
    const VesselTree tree = small_tree();
    CHECK(measure::path_between(tree, {3, 0.5}, {3, 0.5})->length_mm == 0.0);
    const auto near = measure::path_between(tree, {1, 0.5}, {2, 0.5}); // 4 + 3 mm, through the branching
    REQUIRE(near);
    CHECK(near->length_mm == doctest::Approx(7.0));
    CHECK(near->branches == std::vector<int>{1, 2});
    const auto far = measure::path_between(tree, {4, 0.5}, {2, 0.5}); // 2.5 + 8 + 3
    REQUIRE(far);
    CHECK(far->length_mm == doctest::Approx(13.5));
    CHECK(far->branches == std::vector<int>{4, 1, 2});
    double along = 0.0;
    for (std::size_t i = 1; i < far->places.size(); ++i) along += glm::distance(far->places[i - 1], far->places[i]);
    CHECK(along == doctest::Approx(far->length_mm));
    CHECK(far->places.front() == measure::point_on(tree, 4, 0.5).position);
    CHECK(far->places.back() == measure::point_on(tree, 2, 0.5).position);

    // Two ways of 4 and 16 mm between the same nodes, with a stem and a tail of 2 mm.
    const VesselTree ring =
        built_tree({{{-2, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 6, 0}, 1}, {{4, 6, 0}, 1}, {{4, 0, 0}, 1}, {{6, 0, 0}, 1}},
                   {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {1, 4}, {4, 5}});
    REQUIRE(ring.branches.size() == 4);
    const int tail = ring.branches[3].points.size() == 2 ? 3 : 2;
    CHECK(measure::path_between(ring, {0, 0.5}, {tail, 0.5})->length_mm == doctest::Approx(1.0 + 4.0 + 1.0));
    const auto there = measure::path_between(ring, {1, 0.5}, {2, 0.5}),
               back = measure::path_between(ring, {2, 0.5}, {1, 0.5});
    CHECK(there->length_mm == doctest::Approx(8.0 + 2.0));
    CHECK(back->length_mm == doctest::Approx(there->length_mm));

    const VesselTree apart =
        built_tree({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{9, 0, 0}, 1}, {{9, 1, 0}, 1}}, {{0, 1}, {2, 3}}, {0, 2});
    CHECK_FALSE(measure::path_between(apart, {0, 0.5}, {1, 0.5}));
}

TEST_CASE("a path is as long as what lies between its places, wherever they are") {
    const VesselTree tree = small_tree();
    const std::vector<measure::BranchPlace> places{{0, 0.2}, {1, 0.0}, {1, 0.75}, {2, 1.0}, {3, 0.4}, {4, 0.9}};
    for (const auto& from : places) {
        for (const auto& to : places) {
            const auto path = measure::path_between(tree, from, to);
            REQUIRE(path);
            CHECK(path->places.front() == measure::point_on(tree, from).position);
            CHECK(path->places.back() == measure::point_on(tree, to).position);
            double along = 0.0;
            for (std::size_t i = 1; i < path->places.size(); ++i)
                along += glm::distance(path->places[i - 1], path->places[i]);
            CHECK(along == doctest::Approx(path->length_mm));
            CHECK(measure::path_between(tree, to, from)->length_mm == doctest::Approx(path->length_mm));
        }
    }
    CHECK(measure::path_between(tree, {1, 0.25}, {1, 0.75})->length_mm == doctest::Approx(4.0)); // of 8 mm
    CHECK(measure::path_between(tree, {1, 0.75}, {2, 0.5})->length_mm == doctest::Approx(6.0 + 3.0));

    // A ring of 20 mm: the two places are 14 mm apart on their own branch, 6 mm by the other.
    const VesselTree ring =
        built_tree({{{-2, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 6, 0}, 1}, {{4, 6, 0}, 1}, {{4, 0, 0}, 1}, {{6, 0, 0}, 1}},
                   {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {1, 4}, {4, 5}});
    int longest = 0;
    for (int id = 0; id < 4; ++id)
        if (tree::length_mm(ring, ring.branches[static_cast<std::size_t>(id)]) > 15.0) longest = id;
    const auto round = measure::path_between(ring, {longest, 1.0 / 16.0}, {longest, 15.0 / 16.0});
    REQUIRE(round);
    CHECK(round->length_mm == doctest::Approx(1.0 + 4.0 + 1.0));
    CHECK(round->branches.size() == 3);
}

TEST_CASE("an angle between three points is the one at the middle point") {
    CHECK(measure::angle_deg({1, 0, 0}, {0, 0, 0}, {0, 5, 0}) == doctest::Approx(90.0));
    CHECK(measure::angle_deg({1, 0, 0}, {0, 0, 0}, {-7, 0, 0}) == doctest::Approx(180.0));
    CHECK(measure::angle_deg({1, 2, 3}, {1, 2, 3}, {4, 5, 6}) == 0.0);
}

TEST_CASE("angles at a branching are those of its directions") {
    // A stem along z; one branch turns aside by 30 degrees, the other, opposite, by 60.
    const double a = std::numbers::pi / 6.0, b = std::numbers::pi / 3.0;
    const VesselTree tree = built_tree({{{0, 0, 0}, 1},
                                        {{0, 0, 10}, 1},
                                        {{20 * std::sin(a), 0, 10 + 20 * std::cos(a)}, 1},
                                        {{-20 * std::sin(b), 0, 10 + 20 * std::cos(b)}, 1}},
                                       {{0, 1}, {1, 2}, {1, 3}});
    const auto first = measure::branching_of(tree, 1);
    REQUIRE(first.to_parent_deg);
    CHECK(*first.to_parent_deg == doctest::Approx(30.0));
    REQUIRE(first.siblings_deg.size() == 1);
    CHECK(first.siblings_deg[0].first == 2);
    CHECK(first.siblings_deg[0].second == doctest::Approx(90.0));
    CHECK(*measure::branching_of(tree, 2).to_parent_deg == doctest::Approx(60.0));
    CHECK_FALSE(measure::branching_of(tree, 0).to_parent_deg);
    CHECK(measure::end_direction(tree, 0) == glm::dvec3(0.0, 0.0, 1.0));
}
