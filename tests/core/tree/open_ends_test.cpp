// Ends within vessels that the file does not connect them to.
#include "core/tree/build_tree.h"

#include <cmath>
#include <doctest/doctest.h>
#include <string>

namespace ramus::tree {

namespace {

// A vessel of radius 2 along x, and a thinner one that comes down on it from y = 10 and ends at `y`.
Graph trunk_and_twig(double y, double x = 5.0) {
    Graph graph;
    graph.points = {{{0, 0, 0}, 2.0}, {{10, 0, 0}, 2.0}, {{20, 0, 0}, 2.0}, {{x, 10, 0}, 0.5}, {{x, y, 0}, 0.5}};
    graph.edges = {{0, 1}, {1, 2}, {3, 4}};
    graph.roots = {0, 4};
    return graph;
}

VesselTree built(Graph graph, Repair repair = Repair::kUsual) {
    auto tree = build_tree(std::move(graph), repair, [](std::uint32_t point) { return std::to_string(point); });
    REQUIRE(tree.has_value());
    return std::move(*tree);
}

} // namespace

TEST_CASE("an end within another vessel is joined to a new point on its axis") {
    const VesselTree tree = built(trunk_and_twig(1.5));
    CHECK(tree.roots == std::vector<std::uint32_t>{0});
    CHECK(tree.branches.size() == 3);
    REQUIRE(tree.points.size() == 6);
    CHECK(tree.points[5].position == glm::dvec3(5, 0, 0));
    CHECK(tree.points[5].radius == doctest::Approx(2.0));
    CHECK(tree.loop_count == 0);
    REQUIRE(sentences(tree, Note::Kind::kRepaired).size() == 1);
    CHECK(sentences(tree, Note::Kind::kRepaired)[0] == "4: an end within another vessel was joined to it");
    CHECK(tree.notes[0].topic == "open-ends");
    CHECK(tree.notes[0].at == glm::dvec3(5, 1.5, 0));
}

TEST_CASE("an end near a point of the other vessel is joined to that point") {
    const VesselTree tree = built(trunk_and_twig(1.5, 10.2));
    CHECK(tree.points.size() == 5);
    CHECK(tree.branches.size() == 3);
    CHECK(tree.roots.size() == 1);
}

TEST_CASE("an end outside of the other vessel stays, and so do all when ends are not to be joined") {
    CHECK(built(trunk_and_twig(2.1)).roots.size() == 2);
    CHECK(built(trunk_and_twig(1.5), without(Repair::kUsual, Repair::kOpenEnds)).roots.size() == 2);
    CHECK(built(trunk_and_twig(1.5), Repair::kNone).roots.size() == 2);
}

TEST_CASE("vessels of different systems are not joined") {
    Graph graph = trunk_and_twig(1.5);
    graph.systems = {{"portal", {}}, {"hepatic", {}}};
    graph.point_systems = {0, 0, 0, 1, 1};
    CHECK(built(graph).roots.size() == 2);
    graph.point_systems = {1, 1, 1, 1, 1};
    CHECK(built(graph).roots.size() == 1);
}

TEST_CASE("a vessel with both ends in another one is joined by the deeper one: no loop comes about") {
    Graph graph = trunk_and_twig(1.5);
    graph.points.push_back({{15, 0.5, 0}, 0.5});
    graph.edges.emplace_back(3, 5);
    graph.roots = {0, 4};
    const VesselTree tree = built(graph);
    CHECK(tree.roots.size() == 1);
    CHECK(tree.loop_count == 0);
    REQUIRE(sentences(tree, Note::Kind::kRepaired).size() == 1);
    CHECK(sentences(tree, Note::Kind::kRepaired)[0] == "5: an end within another vessel was joined to it");
}

void check_segments_have_length(const VesselTree& tree) {
    for (const Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n)
            CHECK(tree.points[branch.points[n]].position != tree.points[branch.points[n - 1]].position);
}

TEST_CASE("ends that lie at one place of an axis share a point there") {
    Graph graph = trunk_and_twig(0.0);
    graph.points.push_back({{5, 0, 10}, 0.5});
    graph.points.push_back({{5, 0, 0}, 0.5});
    graph.edges.emplace_back(5, 6);
    graph.roots = {0, 4, 6};
    const VesselTree tree = built(graph);
    CHECK(tree.roots.size() == 1);
    CHECK(tree.branches.size() == 4);
    check_segments_have_length(tree);
}

TEST_CASE("an end is joined though its neighbour lies at a point of the axis") {
    Graph graph = trunk_and_twig(10.0, 10.0);
    graph.points[3].position = {10, 0, 0};
    graph.points[4].position = {10.1, 0, 0};
    graph.edges = {{0, 1}, {1, 2}, {3, 4}};
    graph.points.push_back({{10, 10, 0}, 0.5});
    graph.edges.emplace_back(3, 5);
    graph.roots = {0, 4};
    const VesselTree tree = built(graph);
    CHECK(tree.roots.size() == 1);
    check_segments_have_length(tree);
}

TEST_CASE("an end that others were joined to is joined itself, with them") {
    Graph graph;
    // The first vessel ends at the second one's end, which lies on a hair of a third, at a point of it.
    graph.points = {{{1e-5, 0, 0}, 0.5},     {{10, 0, 0}, 0.5},    {{0, 0, 0}, 1.0},     {{0, 10, 0}, 1.0},
                    {{0, 0, 1.5e-11}, 1e-6}, {{-10, 0, 10}, 1e-6}, {{-10, 0, -10}, 1e-6}};
    graph.edges = {{0, 1}, {2, 3}, {5, 4}, {4, 6}};
    graph.roots = {1, 3, 5};
    const VesselTree tree = built(graph);
    CHECK(tree.roots.size() == 1);
    CHECK(tree.branches.size() == 4);
    check_segments_have_length(tree);
    double length = 0.0;
    for (const Branch& branch : tree.branches) length += length_mm(tree, branch);
    CHECK(length == doctest::Approx(10.0 + 10.0 + 2.0 * std::sqrt(200.0)));
}

TEST_CASE("many ends on one segment, in any order, cut it into parts that follow each other") {
    Graph graph;
    graph.points = {{{0, 0, 0}, 2.0}, {{100, 0, 0}, 2.0}};
    graph.edges = {{0, 1}};
    graph.roots = {0};
    for (const double x : {50.0, 20.0, 80.0, 35.0, 65.0, 90.0, 5.0}) {
        const auto end = static_cast<std::uint32_t>(graph.points.size());
        graph.points.push_back({{x, 1.0, 0}, 0.5});
        graph.points.push_back({{x, 10.0, 0}, 0.5});
        graph.edges.emplace_back(end, end + 1);
        graph.roots.push_back(end + 1);
    }
    const VesselTree tree = built(graph);
    CHECK(tree.roots == std::vector<std::uint32_t>{0});
    CHECK(tree.branches.size() == 15);
    double trunk = 0.0;
    for (const Branch& branch : tree.branches)
        if (tree.points[branch.points.back()].position.y == 0.0) trunk += length_mm(tree, branch);
    CHECK(trunk == doctest::Approx(100.0));
}

} // namespace ramus::tree
