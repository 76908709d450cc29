// Points and edges become branches with a hierarchy; what can be repaired is, and is told.
#include "core/io/trees/swc.h"
#include "core/tree/build_tree.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace ramus;
using tree::Note;
using tree::Repair;

namespace {

std::string place(std::uint32_t point) { return "point " + std::to_string(point); }

tree::Graph chain(std::uint32_t count) {
    tree::Graph graph;
    for (std::uint32_t i = 0; i < count; ++i) {
        graph.points.push_back({{0.0, 0.0, static_cast<double>(i)}, 1.0});
        if (i > 0) graph.edges.emplace_back(i - 1, i);
    }
    return graph;
}

tree::VesselTree built(tree::Graph graph) {
    auto tree = tree::build_tree(std::move(graph), tree::without(Repair::kAll, Repair::kOpenEnds), place);
    REQUIRE(tree.has_value());
    return *tree;
}

// A stem along z from 0 to `stem` mm, and at its end twigs of the given lengths along x, y, -x, -y; radius 1.
tree::Graph fork(double stem, std::initializer_list<double> twigs) {
    const glm::dvec3 directions[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 1.0}, {{0, 0, stem}, 1.0}};
    graph.edges = {{0, 1}};
    graph.roots = {0};
    for (const double length : twigs) {
        const auto point = static_cast<std::uint32_t>(graph.points.size());
        graph.points.push_back({glm::dvec3(0, 0, stem) + length * directions[point - 2], 1.0});
        graph.edges.emplace_back(1, point);
    }
    return graph;
}

// What VesselTree promises, whatever it was made from.
void check_promises(const tree::VesselTree& tree, std::size_t edges) {
    CHECK(tree.segment_count() == edges);
    std::vector<int> degree(tree.points.size(), 0);
    for (const auto& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i)
            ++degree[branch.points[i - 1]], ++degree[branch.points[i]];
    const auto is_root = [&](std::uint32_t p) { return std::ranges::find(tree.roots, p) != tree.roots.end(); };
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        REQUIRE(branch.points.size() >= 2);
        CHECK(tree::length_mm(tree, branch) > 0.0);
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) CHECK(degree[branch.points[i]] == 2);
        if (branch.parent == tree::kNoBranch) {
            CHECK(is_root(branch.points.front()));
            CHECK(branch.generation == 0);
        } else {
            const tree::Branch& parent = tree.branches[static_cast<std::size_t>(branch.parent)];
            CHECK(branch.points.front() == parent.points.back());
            CHECK(branch.generation == parent.generation + 1);
            CHECK(std::ranges::count(parent.children, static_cast<int>(id)) == 1);
        }
        CHECK(std::ranges::is_sorted(branch.children));
    }
}

} // namespace

TEST_CASE("a fork has a stem and its twigs") {
    const auto tree = built(fork(10.0, {4.0, 5.0}));
    check_promises(tree, 3);
    REQUIRE(tree.branches.size() == 3);
    CHECK(tree.branches[0].children == std::vector<int>{1, 2});
    CHECK(tree.branches[0].strahler == 2);
    CHECK(tree.branches[1].strahler == 1);
    CHECK(tree.branches[2].generation == 1);
    CHECK(tree.roots == std::vector<std::uint32_t>{0});
}

TEST_CASE("Strahler's order rises where two of the highest meet, and only there") {
    // A caterpillar: single twigs along a stem leave the order at 2, however many there are.
    tree::Graph graph = chain(6);
    for (std::uint32_t i = 1; i < 5; ++i) {
        graph.points.push_back({{1.0, 0.0, static_cast<double>(i)}, 0.5});
        graph.edges.emplace_back(i, 5 + i);
    }
    graph.roots = {0};
    const auto tree = built(graph);
    check_promises(tree, 9);
    CHECK(tree.branches[0].strahler == 2);
}

TEST_CASE("edges may run against the flow and points stand in any order") {
    tree::Graph graph = fork(10.0, {4.0, 5.0});
    for (auto& [a, b] : graph.edges) std::swap(a, b);
    std::ranges::reverse(graph.edges);
    check_promises(built(graph), 3);
}

TEST_CASE("without a root the thickest end is one, in every component") {
    tree::Graph graph = chain(5);
    graph.points[4].radius = 3.0;
    graph.points[2].radius = 9.0; // thicker, but no end
    graph.points.push_back({{5, 0, 0}, 1.0});
    graph.points.push_back({{6, 0, 0}, 2.0});
    graph.edges.emplace_back(5, 6);
    const auto tree = built(graph);
    CHECK(tree.roots == std::vector<std::uint32_t>{4, 6});
    CHECK(tree.branches[0].points == std::vector<std::uint32_t>{4, 3, 2, 1, 0});
}

TEST_CASE("loops keep every branch, and the hierarchy spans them") {
    SUBCASE("a ring with a stem") {
        tree::Graph graph = chain(6);
        graph.edges.emplace_back(5, 1);
        graph.roots = {0};
        const auto tree = built(graph);
        check_promises(tree, 6);
        CHECK(tree.branches.size() == 2);
        CHECK(tree.loop_count == 1);
    }
    SUBCASE("a ring alone") {
        tree::Graph graph = chain(6);
        graph.edges.emplace_back(5, 0);
        const auto tree = built(graph);
        check_promises(tree, 6);
        CHECK(tree.branches.size() == 1);
        CHECK(tree.loop_count == 1);
        CHECK(tree.branches[0].points.front() == tree.branches[0].points.back());
    }
    SUBCASE("two ways between the same nodes") {
        tree::Graph graph = chain(5); // 0-1-2-3-4, and 1-5-3
        graph.points.push_back({{1, 0, 2}, 1.0});
        graph.edges.emplace_back(1, 5);
        graph.edges.emplace_back(5, 3);
        graph.roots = {0};
        const auto tree = built(graph);
        check_promises(tree, 6);
        CHECK(tree.branches.size() == 4);
        CHECK(tree.loop_count == 1);
        // What lies behind both ways depends on the stem before them and on neither of the two.
        CHECK(tree::subtree(tree, 0).size() == 4);
        for (const int way : {1, 2}) CHECK(tree::subtree(tree, way) == std::vector<int>{way});
    }
}

TEST_CASE("graphs at random keep every promise") {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
        tree::Graph graph = chain(2 + below(30));
        const auto count = static_cast<std::uint32_t>(graph.points.size());
        graph.edges.clear();
        std::vector<std::pair<std::uint32_t, std::uint32_t>> distinct;
        for (std::uint32_t e = 0; e < 1 + below(40); ++e) {
            const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(below(count), below(count));
            if (edge.first == edge.second) continue;
            graph.edges.push_back(edge);
            if (std::ranges::find(distinct, edge) == distinct.end()) distinct.push_back(edge);
        }
        if (distinct.empty()) continue;
        if (below(2) == 0) graph.roots = {below(count)};
        const auto tree = built(graph);
        check_promises(tree, distinct.size());
        // Independent cycles: edges - nodes + components.
        CHECK(tree.loop_count == static_cast<int>(distinct.size() + tree.roots.size() - tree.points.size()));
        // Nothing is pruned away at a ratio of 0.
        CHECK(tree::prune(tree, 0.0).tree == tree);
    }
}

TEST_CASE("a chain of a hundred thousand points is one branch, with all radii missing but one") {
    tree::Graph graph = chain(100000);
    for (auto& point : graph.points) point.radius = 0.0;
    graph.points.back().radius = 2.0;
    const auto tree = built(graph);
    CHECK(tree.branches.size() == 1);
    CHECK(sentences(tree, Note::Kind::kRepaired).size() == 99999);
    CHECK(std::ranges::all_of(tree.points, [](const auto& p) { return p.radius == 2.0; }));
}

TEST_CASE("a zero radius is interpolated from positive radii, by the length between") {
    tree::Graph graph = fork(10.0, {4.0, 5.0});
    graph.points[0].radius = 3.0;
    graph.points[1].radius = 0.0;
    graph.points[2].radius = 1.0;
    graph.points[3].radius = 0.0; // not positive: counts neither for its neighbour nor before it
    const auto tree = built(graph);
    const double expected = (3.0 / 10.0 + 1.0 / 4.0) / (1.0 / 10.0 + 1.0 / 4.0);
    CHECK(tree.points[1].radius == doctest::Approx(expected));
    CHECK(tree.points[3].radius == doctest::Approx(expected)); // an end: nothing is measured beyond
    REQUIRE(sentences(tree, Note::Kind::kRepaired).size() == 2);
    CHECK(tree.notes[0].text.find("point 1") != std::string::npos);
    CHECK(tree.notes[0].at == tree.points[1].position);
    const auto refused = tree::build_tree(graph, Repair::kNone, place);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().message().find("point 1") != std::string::npos);
}

TEST_CASE("repeated points are merged and lonely ones left out, each with a word") {
    tree::Graph graph = chain(4);
    graph.points[2].position = graph.points[1].position;
    graph.points.push_back({{9, 9, 9}, 1.0});
    const auto tree = built(graph);
    check_promises(tree, 2);
    CHECK(tree.points.size() == 3);
    CHECK(sentences(tree, Note::Kind::kRepaired).size() == 2);
    CHECK_FALSE(tree::build_tree(graph, Repair::kNone, place).has_value());
}

TEST_CASE("pruning drops leaf branches shorter than the ratio of their parent") {
    SUBCASE("exactly the ratio stays") {
        CHECK(tree::prune(built(fork(10.0, {5.0, 5.0})), 0.5).tree.branches.size() == 3);
    }
    SUBCASE("a node left with two branches becomes an inner point, and segments keep their ids") {
        const auto source = built(fork(10.0, {8.0, 2.0}));
        const auto pruned = tree::prune(source, 0.5);
        REQUIRE(pruned.tree.branches.size() == 1);
        CHECK(pruned.tree.points.size() == 3);
        CHECK(tree::length_mm(pruned.tree, pruned.tree.branches[0]) == 18.0);
        CHECK(pruned.segment_source == std::vector<int>{0, 1});
    }
    SUBCASE("it repeats until nothing goes") {
        // 10 mm of stem, 8 mm on, then twigs of 9 and 1 mm; a twig of 6 mm where the stem ends. The 1 mm twig goes;
        // the others stay: 6 >= 0.5 * 10 and 8 + 9 >= 0.5 * 10. At 0.65 the 6 mm twig goes too.
        tree::Graph graph = fork(10.0, {8.0, 6.0});
        graph.points.push_back({{17, 0, 10}, 1.0});
        graph.points.push_back({{8, 1, 10}, 1.0});
        graph.edges.emplace_back(2, 4);
        graph.edges.emplace_back(2, 5);
        const auto source = built(graph);
        CHECK(tree::prune(source, 0.5).tree.branches.size() == 3);
        const auto pruned = tree::prune(source, 0.65);
        CHECK(pruned.tree.branches.size() == 1);
        CHECK(tree::length_mm(pruned.tree, pruned.tree.branches[0]) == 27.0);
        CHECK(pruned.tree.source == source.source);
    }
    SUBCASE("the stem of a tree stays") {
        const auto pruned = tree::prune(built(fork(10.0, {1.0, 1.0})), 1e9);
        CHECK(pruned.tree.branches.size() == 1);
        CHECK(pruned.tree.points.size() == 2);
    }
}

TEST_CASE("numbers with decimal commas are not misread as more columns") {
    CHECK(io::parse_tree("1 0 0 0 0 1 -1\n2 0 0 0 1 1 1\n", "a.swc").has_value());
    CHECK(io::parse_tree("1,0,0,0,0,1,-1\n2,0,0,0,1,1,1\n", "a.swc").has_value());
    // Decimal commas, which would make eleven columns.
    CHECK_FALSE(io::parse_tree("0 0 0,5 0,5 0,5 1,0 -1\n1 0 0,5 0,5 1,5 1,0 0\n", "a.swc").has_value());
}

TEST_CASE("a root that a branch of another root runs through is none") {
    tree::Graph graph = chain(3);
    graph.roots = {0, 1};
    const tree::VesselTree tree = built(graph);
    CHECK(tree.roots == std::vector<std::uint32_t>{0});
    CHECK(tree.branches.size() == 1);
    CHECK(tree.loop_count == 0);
    // The other way round it is the root, and what hangs on either side depends on it separately.
    graph.roots = {1, 0};
    const tree::VesselTree other = built(graph);
    CHECK(other.roots == std::vector<std::uint32_t>{1});
    CHECK(other.branches.size() == 2);
    CHECK(other.loop_count == 0);
}
