#include "core/tree/dependency.h"
#include "core/tree/network.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>
#include <set>

using namespace ramus;
using tree::Dependency;
using tree::VesselTree;
using Ids = std::vector<int>;

namespace {

VesselTree built(std::size_t count, std::vector<tree::Edge> edges, std::vector<std::uint32_t> roots = {0}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0.0, 100.0);
    std::vector<tree::Point> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({{place(random), place(random), place(random)}, 1.0});
    return test::built_tree(std::move(points), std::move(edges), std::move(roots));
}

// A tree of `points`, with `extra` more ways and chains of points in between; sometimes in several components.
VesselTree random_network(std::mt19937& random, std::uint32_t points, std::uint32_t extra, std::uint32_t components) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    std::vector<std::uint32_t> roots;
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (a != b && known.emplace(std::min(a, b), std::max(a, b)).second) edges.emplace_back(a, b);
    };
    for (std::uint32_t c = 0; c < components; ++c) {
        const std::uint32_t first = c * points;
        roots.push_back(first + random() % points);
        for (std::uint32_t i = 1; i < points; ++i) join(first + i, first + random() % i);
        for (std::uint32_t i = 0; i < extra; ++i) join(first + random() % points, first + random() % points);
    }
    std::ranges::shuffle(edges, random);
    return built(std::size_t{points} * components, std::move(edges), std::move(roots));
}

// What the roots do not reach any more without `gone`, itself left out.
Ids unreached_without(const VesselTree& tree, int gone) {
    const tree::Network network(tree);
    std::vector<char> reached(static_cast<std::size_t>(network.node_count()), 0);
    Ids open = network.roots;
    for (const int root : open) reached[static_cast<std::size_t>(root)] = 1;
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        for (const int b : network.at(node)) {
            const int next = network.across(b, node);
            if (b == gone || reached[static_cast<std::size_t>(next)] != 0) continue;
            reached[static_cast<std::size_t>(next)] = 1;
            open.push_back(next);
        }
    }
    Ids lost;
    for (int b = 0; b < static_cast<int>(tree.branches.size()); ++b) {
        const auto& [start, end] = network.ends[static_cast<std::size_t>(b)];
        if (b != gone && reached[static_cast<std::size_t>(start)] == 0 && reached[static_cast<std::size_t>(end)] == 0)
            lost.push_back(b);
    }
    return lost;
}

Ids sorted(std::span<const int> ids) {
    Ids all(ids.begin(), ids.end());
    std::ranges::sort(all);
    return all;
}

void check_against_brute_force(const VesselTree& tree) {
    const Dependency dependency(tree);
    const int count = dependency.branch_count();
    REQUIRE(count == static_cast<int>(tree.branches.size()));
    for (int b = 0; b < count; ++b) {
        CAPTURE(b);
        const Ids lost = unreached_without(tree, b);
        CHECK(sorted(dependency.dependents(b)) == lost);
        CHECK(dependency.with_dependents(b)[0] == b);
        if (!lost.empty()) CHECK(dependency.is_bridge(b));
        for (int other = 0; other < count; ++other) {
            const bool expected = std::ranges::binary_search(lost, other);
            CHECK(dependency.depends(other, b) == expected);
            const Ids upstream = dependency.upstream(other); // and downstream agree
            CHECK((std::ranges::find(upstream, b) != upstream.end()) == expected);
        }
    }
}

} // namespace

TEST_CASE("in a tree all descendants depend") {
    // 0 - 1 - 2, 1 - 3 - 4, 3 - 5
    const VesselTree tree = built(6, {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}});
    const Dependency dependency(tree);
    CHECK(sorted(dependency.dependents(0)) == Ids{1, 2, 3, 4});
    CHECK(sorted(dependency.with_dependents(2)) == Ids{2, 3, 4});
    CHECK(dependency.dependents(1).empty());
    CHECK(dependency.upstream(4) == Ids{2, 0});
    CHECK(dependency.parent(0) == tree::kNoBranch);
    CHECK(dependency.with_dependents(Ids{4, 2, 1, 2}) == Ids{1, 2, 3, 4});
    CHECK(dependency.with_dependents(Ids{}).empty());
}

TEST_CASE("what is reached another way round does not depend") {
    // A stem, two ways between the same nodes, and what lies behind.
    const VesselTree tree = built(7, {{0, 1}, {1, 2}, {2, 4}, {1, 3}, {3, 4}, {4, 5}, {5, 6}});
    REQUIRE(tree.branches.size() == 4);
    REQUIRE(tree.loop_count == 1);
    const Dependency dependency(tree);
    CHECK(sorted(dependency.dependents(0)) == Ids{1, 2, 3});
    for (const int way : {1, 2}) {
        CHECK_FALSE(dependency.is_bridge(way));
        CHECK(dependency.dependents(way).empty());
    }
    CHECK(dependency.is_bridge(3));
    CHECK(dependency.parent(3) == 0);
    check_against_brute_force(tree);
}

TEST_CASE("loops at the root, rings alone and branches that come back to themselves") {
    check_against_brute_force(built(4, {{0, 1}, {1, 2}, {2, 0}, {1, 3}}));
    check_against_brute_force(built(3, {{0, 1}, {1, 2}, {2, 0}}));
    check_against_brute_force(built(5, {{0, 1}, {1, 2}, {2, 3}, {3, 1}, {0, 4}}));
}

TEST_CASE("dependency agrees with taking every branch away, on trees and networks at random") {
    std::mt19937 random(11);
    for (int round = 0; round < 150; ++round) {
        const std::uint32_t points = 2 + random() % 24;
        const std::uint32_t extra = round % 3 == 0 ? 0 : random() % 8;
        const VesselTree tree = random_network(random, points, extra, 1 + random() % 3);
        CAPTURE(round);
        check_against_brute_force(tree);
    }
}

TEST_CASE("subtrees nest, and the order has each branch once, after what it depends on") {
    std::mt19937 random(23);
    for (int round = 0; round < 60; ++round) {
        const VesselTree tree = random_network(random, 40, random() % 12, 2);
        const Dependency dependency(tree);
        CHECK(std::set(dependency.order().begin(), dependency.order().end()).size() == tree.branches.size());
        for (int a = 0; a < dependency.branch_count(); ++a) {
            const auto below_a = dependency.with_dependents(a);
            for (const int b : below_a)
                for (const int c : dependency.with_dependents(b)) CHECK(std::ranges::find(below_a, c) != below_a.end());
            for (int b = 0; b < dependency.branch_count(); ++b) { // or are apart
                if (a == b || dependency.depends(a, b) || dependency.depends(b, a)) continue;
                for (const int c : dependency.with_dependents(b)) CHECK(std::ranges::find(below_a, c) == below_a.end());
            }
        }
        Ids some;
        for (int i = 0; i < 5; ++i) some.push_back(static_cast<int>(random() % tree.branches.size()));
        std::set<int> expected;
        for (const int b : some)
            for (const int c : dependency.with_dependents(b)) expected.insert(c);
        CHECK(dependency.with_dependents(some) == Ids(expected.begin(), expected.end()));
    }
}

// Work that grew with the square of the rungs, or recursion as deep, would not end; how soon large trees are done is
// measured by tests/bench/explore_bench.cpp.
TEST_CASE("a ladder of 20,000 loops has no branch that depends on another") {
    // Every rung but the last few closes a loop that shares its ways with all before it.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges{{0, 1}};
    constexpr std::uint32_t kRungs = 20000;
    for (std::uint32_t i = 0; i < kRungs; ++i) {
        edges.emplace_back(2 * i, 2 * i + 2);
        edges.emplace_back(2 * i + 1, 2 * i + 3);
        edges.emplace_back(2 * i + 2, 2 * i + 3);
    }
    edges.emplace_back(2 * kRungs, 2 * kRungs + 2);
    const VesselTree ladder = built(2 * kRungs + 3, std::move(edges));
    const Dependency of_ladder(ladder);
    for (int b = 0; b < of_ladder.branch_count(); ++b) CHECK(of_ladder.dependents(b).empty());
}
