// The flat picture of a tree: nothing overlaps, parents span their children, and its cost is that of its pixels.
#include "app/picture/overview_layout.h"
#include "tests/support/grown_tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <map>
#include <random>

using namespace ramus;
using namespace ramus::app;

namespace {

tree::VesselTree built(const std::vector<glm::dvec3>& positions,
                       std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, std::vector<std::uint32_t> roots) {
    tree::Graph graph;
    for (const glm::dvec3& position : positions) graph.points.push_back({position, 1.0});
    graph.edges = std::move(edges);
    graph.roots = std::move(roots);
    auto tree = tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string(); });
    REQUIRE(tree);
    return *tree;
}

// A ladder: two stems with rungs, each rung but the first closes a loop. And a second tree beside it.
tree::VesselTree ladder(int rungs) {
    std::vector<glm::dvec3> positions{{0, 0, 0}};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::uint32_t left = 0, right = 0;
    for (int i = 1; i <= rungs; ++i) {
        positions.push_back({-5.0, 0.0, -4.0 * i});
        positions.push_back({5.0, 0.0, -4.0 * i - 1.0});
        const auto next = static_cast<std::uint32_t>(positions.size()) - 2;
        edges.emplace_back(left, next);
        edges.emplace_back(right, next + 1);
        edges.emplace_back(next, next + 1);
        left = next, right = next + 1;
    }
    const auto other = static_cast<std::uint32_t>(positions.size());
    for (const glm::dvec3& p :
         {glm::dvec3(40, 0, 0), glm::dvec3(40, 0, -9), glm::dvec3(35, 0, -15), glm::dvec3(45, 0, -14)})
        positions.push_back(p);
    edges.emplace_back(other, other + 1);
    edges.emplace_back(other + 1, other + 2);
    edges.emplace_back(other + 1, other + 3);
    return built(positions, std::move(edges), {0, other});
}

void check_layout(const tree::VesselTree& tree, OverviewDepth depth) {
    const TreeFacts facts = facts_of(tree);
    const OverviewLayout layout = overview_layout(tree, facts, depth);
    REQUIRE(layout.lines.size() == tree.branches.size());
    CHECK(layout.order.size() + layout.links.size() == tree.branches.size());
    CHECK(static_cast<int>(layout.links.size()) <= tree.loop_count);

    std::map<double, std::vector<std::pair<double, double>>> across;
    double deepest = 0.0;
    std::vector<double> leaves;
    for (const int id : layout.order) {
        const OverviewLine& line = layout.lines[static_cast<std::size_t>(id)];
        CHECK(line.from >= 0.0);
        CHECK(line.to > line.from);
        CHECK(line.to <= 1.0 + 1e-12);
        CHECK(line.at > 0.0);
        CHECK(line.at < 1.0);
        deepest = std::max(deepest, line.to);
        across[line.at].emplace_back(line.from, line.to);
        const auto first = static_cast<std::size_t>(layout.first_child[static_cast<std::size_t>(id)]);
        const auto last = static_cast<std::size_t>(layout.first_child[static_cast<std::size_t>(id) + 1]);
        if (first == last) {
            leaves.push_back(line.at);
            continue;
        }
        // A parent stands between its first and last child and begins above them; their rooms are apart and within its.
        double edge = line.first;
        for (std::size_t i = first; i < last; ++i) {
            const OverviewLine& child = layout.lines[static_cast<std::size_t>(layout.children[i])];
            CHECK(child.from == doctest::Approx(line.to));
            CHECK(child.first >= edge - 1e-12);
            CHECK(child.begin > line.begin);
            CHECK(child.end <= line.end);
            edge = child.last;
        }
        CHECK(edge <= line.last + 1e-12);
        CHECK(line.at >= layout.lines[static_cast<std::size_t>(layout.children[first])].at - 1e-12);
        CHECK(line.at <= layout.lines[static_cast<std::size_t>(layout.children[last - 1])].at + 1e-12);
    }
    CHECK(deepest == doctest::Approx(1.0));
    for (auto& [at, spans] : across) {
        std::ranges::sort(spans);
        for (std::size_t i = 1; i < spans.size(); ++i) CHECK(spans[i].first >= spans[i - 1].second - 1e-12);
    }
    // Leaves are evenly spaced, but for a gap between trees.
    REQUIRE(static_cast<int>(leaves.size()) == layout.leaves);
    const double slots = layout.leaves + static_cast<double>(tree.roots.size()) - 1.0;
    for (std::size_t i = 1; i < leaves.size(); ++i) {
        const double steps = (leaves[i] - leaves[i - 1]) * slots;
        CHECK(std::abs(steps - std::round(steps)) < 1e-6);
        CHECK(steps > 0.5);
        CHECK(steps < 2.5);
    }
}

} // namespace

TEST_CASE("in the overview no branches overlap and parents span their children") {
    for (const auto depth : {OverviewDepth::kGeneration, OverviewDepth::kDistance}) {
        for (const int branches : {1, 3, 60, 1500}) check_layout(test::grown(branches), depth);
        for (const int rungs : {1, 2, 30}) check_layout(ladder(rungs), depth);
        check_layout(built({{0, 0, 0}, {0, 0, 5}}, {{0, 1}}, {0}), depth);
        check_layout(built({{0, 0, 0}, {0, 0, 5}, {5, 0, 5}}, {{0, 1}, {1, 2}, {2, 0}}, {0}), depth); // a ring
    }
}

TEST_CASE("loops are links between ends that the overview shows") {
    const tree::VesselTree tree = ladder(5);
    CHECK(tree.loop_count == 5);
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kGeneration);
    CHECK(layout.links.size() == 5);
    for (const OverviewLink& link : layout.links) {
        for (const glm::dvec2 end : {link.from, link.to}) {
            const bool met = std::ranges::any_of(layout.order, [&](int id) {
                const OverviewLine& line = layout.lines[static_cast<std::size_t>(id)];
                return line.at == end.x && line.to == end.y;
            });
            CHECK((met || end.y == 0.0));
        }
        CHECK(link.from != link.to);
    }
}

TEST_CASE("the left side of the overview is the left side of the anterior view") {
    // RAS: from the front, the patient's right (+x) is at the left.
    const tree::VesselTree tree =
        built({{0, 0, 10}, {0, 0, 0}, {-8, 0, -5}, {8, 0, -5}}, {{0, 1}, {1, 2}, {1, 3}}, {0});
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kGeneration);
    REQUIRE(layout.order.size() == 3);
    const auto x_of_end = [&](int id) {
        return tree.points[tree.branches[static_cast<std::size_t>(id)].points.back()].position.x;
    };
    CHECK(x_of_end(layout.order[1]) == 8.0);
    CHECK(x_of_end(layout.order[2]) == -8.0);
    // So do several trees side by side.
    const tree::VesselTree two = built({{0, 0, 10}, {0, 0, 0}, {50, 0, 10}, {50, 0, 0}}, {{0, 1}, {2, 3}}, {0, 2});
    const OverviewLayout beside = overview_layout(two, facts_of(two), OverviewDepth::kGeneration);
    REQUIRE(beside.order.size() == 2);
    CHECK(two.points[two.branches[static_cast<std::size_t>(beside.order[0])].points.back()].position.x == 50.0);
}

TEST_CASE("thirty thousand branches are drawn as few pieces" *
          doctest::test_suite("slow")) { // how soon: tests/bench/explore_bench.cpp
    const tree::VesselTree tree = test::grown(30000);
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kDistance);
    OverviewView view;
    view.pixels = {1200.0, 200.0};
    const std::vector<OverviewPiece> pieces = visible_pieces(layout, view);
    CHECK(pieces.size() < 4 * 1200);
    // Every branch is in one of them.
    std::vector<int> covered(layout.order.size(), 0);
    for (const OverviewPiece& piece : pieces) {
        const OverviewLine& line = layout.lines[static_cast<std::size_t>(piece.branch)];
        for (int i = line.begin; i < (piece.merged ? line.end : line.begin + 1); ++i)
            ++covered[static_cast<std::size_t>(i)];
    }
    CHECK(std::ranges::all_of(covered, [](int times) { return times == 1; }));
    // Close up, branches stand alone.
    const OverviewView close = zoomed(view, layout, {600.0, 100.0}, {1e9, 1.0});
    for (const OverviewPiece& piece : visible_pieces(layout, close)) CHECK_FALSE(piece.merged);
}

TEST_CASE("the overview picks the branch whose line is nearest to the pointer") {
    const tree::VesselTree tree = ladder(8);
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kDistance);
    OverviewView view;
    view.pixels = {800.0, 300.0};
    for (const int id : layout.order) {
        const OverviewLine& line = layout.lines[static_cast<std::size_t>(id)];
        const glm::dvec2 middle = view.to_pixel({line.at, 0.5 * (line.from + line.to)});
        CHECK(branch_near(layout, view, middle + glm::dvec2(0.4, 0.0), 4.0) == id);
    }
    CHECK(branch_near(layout, view, {-20.0, -20.0}, 4.0) == tree::kNoBranch);
    // The same answer as looking at all of them, on a tree where nothing is merged.
    const tree::VesselTree large = test::grown(300);
    const OverviewLayout wide = overview_layout(large, facts_of(large), OverviewDepth::kGeneration);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 pixel = view.pixels * glm::dvec2(any(random), any(random));
        bool expected = false;
        for (const int id : wide.order) {
            const OverviewLine& line = wide.lines[static_cast<std::size_t>(id)];
            const glm::dvec2 a = view.to_pixel({line.at, line.from});
            const glm::dvec2 b = view.to_pixel({line.at, line.to});
            expected = expected || (std::abs(pixel.x - a.x) <= 3.0 && pixel.y >= a.y && pixel.y <= b.y);
        }
        const bool found = branch_near(wide, view, pixel, 3.0) != tree::kNoBranch;
        hits += found ? 1 : 0;
        if (expected) CHECK(found);
    }
    CHECK(hits > 200);
}

TEST_CASE("zooming in the overview keeps the place under the pointer, panning stays within") {
    const tree::VesselTree tree = test::grown(2000);
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kGeneration);
    OverviewView view;
    view.pixels = {900.0, 200.0};
    const glm::dvec2 at{300.0, 80.0};
    const glm::dvec2 place = view.to_unit(at);
    OverviewView close = zoomed(view, layout, at, {3.0, 2.0});
    CHECK(glm::distance(close.to_unit(at), place) < 1e-12);
    CHECK(close.most.x - close.least.x == doctest::Approx(1.0 / 3.0));
    CHECK(zoomed(close, layout, at, {1e-6, 1e-6}) == view);
    const OverviewView moved = panned(close, {10.0, 5.0});
    CHECK(glm::distance(moved.to_pixel(place), at + glm::dvec2(10.0, 5.0)) < 1e-9);
    const OverviewView corner = panned(close, {1e9, 1e9});
    CHECK(corner.least == glm::dvec2(0.0));
    CHECK(corner.most.x - corner.least.x == doctest::Approx(1.0 / 3.0));
}

TEST_CASE("a lasso in the overview takes branches with half their line inside") {
    const tree::VesselTree tree = test::grown(400);
    const OverviewLayout layout = overview_layout(tree, facts_of(tree), OverviewDepth::kGeneration);
    const std::vector<glm::dvec2> all{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}};
    CHECK(branches_within(layout, all).size() == tree.branches.size());
    CHECK(branches_within(layout, std::vector<glm::dvec2>{{0, 0}, {1, 1}}).empty());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-0.1, 1.1);
    for (int round = 0; round < 20; ++round) {
        std::vector<glm::dvec2> polygon;
        for (int i = 0; i < 7; ++i) polygon.emplace_back(any(random), any(random));
        const auto inside = [&](glm::dvec2 p) {
            bool odd = false;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
            }
            return odd;
        };
        const std::vector<int> taken = branches_within(layout, polygon);
        for (const int id : layout.order) {
            const OverviewLine& line = layout.lines[static_cast<std::size_t>(id)];
            constexpr int kSteps = 2000;
            int within = 0;
            for (int i = 0; i < kSteps; ++i)
                within += inside({line.at, line.from + (line.to - line.from) * (i + 0.5) / kSteps}) ? 1 : 0;
            if (std::abs(within - kSteps / 2) <= 8) continue; // too close for counting
            CHECK(std::ranges::binary_search(taken, id) == (2 * within > kSteps));
        }
    }
}
