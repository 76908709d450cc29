// What a tree of vessels has seldom is told, with its place, and nothing is changed for it.
#include "core/tree/build_tree.h"
#include "core/tree/suspicions.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using tree::Note;
using tree::Repair;

namespace {

std::string place_of(std::uint32_t point) { return "point " + std::to_string(point); }

// Along z, 1 mm apart, of radius 1.
tree::Graph chain_of(std::uint32_t count) {
    tree::Graph graph;
    for (std::uint32_t i = 0; i < count; ++i) {
        graph.points.push_back({{0.0, 0.0, static_cast<double>(i)}, 1.0});
        if (i > 0) graph.edges.emplace_back(i - 1, i);
    }
    return graph;
}

std::vector<tree::Note> suspicions(const tree::VesselTree& tree, const std::string& topic) {
    std::vector<tree::Note> found;
    for (const tree::Note& note : tree.notes)
        if (note.kind == Note::Kind::kSuspect && note.topic == topic) found.push_back(note);
    return found;
}

tree::VesselTree usual(tree::Graph graph, Repair repair = Repair::kUsual) {
    auto tree = tree::build_tree(std::move(graph), repair, place_of);
    REQUIRE(tree);
    return std::move(*tree);
}

} // namespace

TEST_CASE("radii that jump are told with their places, and left as they are unless asked for") {
    tree::Graph graph = chain_of(8); // all radii are 1
    graph.points[3].radius = 3.5;    // more than three times those on both sides
    const auto tree = usual(graph);
    REQUIRE(suspicions(tree, "radius-jumps").size() == 1);
    CHECK(suspicions(tree, "radius-jumps")[0].at == graph.points[3].position);
    CHECK(tree.points[3].radius == 3.5);
    const auto mended = usual(graph, Repair::kAll); // with every repair
    CHECK(mended.points[3].radius == 1.0);
    CHECK(suspicions(mended, "radius-jumps").empty());
    SUBCASE("an end that is thicker than what leads to it, not one that is thinner") {
        graph.points[3].radius = 1.0;
        graph.points[0].radius = 0.025;
        CHECK(suspicions(usual(graph), "radius-jumps").empty());
        graph.points[0].radius = 0.015; // less than a fiftieth
        CHECK(suspicions(usual(graph), "radius-jumps").size() == 1);
        graph.points[0].radius = 3.5;
        REQUIRE(suspicions(usual(graph), "radius-jumps").size() == 1);
        CHECK(usual(graph, Repair::kAll).points[0].radius == 3.5); // it has one neighbour, and no mean to take
    }
    SUBCASE("a step along the vessel, between its points") {
        for (std::size_t p = 3; p < 8; ++p) graph.points[p].radius = 5.5;
        const auto steps = suspicions(usual(graph), "radius-jumps");
        REQUIRE(steps.size() == 1);
        CHECK(steps[0].at == 0.5 * (graph.points[2].position + graph.points[3].position));
        for (std::size_t p = 3; p < 8; ++p) graph.points[p].radius = 4.5;
        CHECK(suspicions(usual(graph), "radius-jumps").empty());
    }
}

TEST_CASE("a radius that is larger than its vessel is long, or next to nothing, is told") {
    tree::Graph graph = chain_of(4);
    const double length = glm::distance(graph.points[0].position, graph.points[3].position);
    for (tree::Point& point : graph.points) point.radius = 1.1 * length;
    graph.points[2].radius = 1.2 * length;
    const auto found = suspicions(usual(graph), "radii");
    REQUIRE(found.size() == 1); // one a piece, at its thickest point
    CHECK(found[0].at == graph.points[2].position);
    for (tree::Point& point : graph.points) point.radius = 0.9 * length;
    CHECK(suspicions(usual(graph), "radii").empty());
    graph.points[3].radius = 0.8e-4 * length;
    CHECK(suspicions(usual(graph), "radii").size() == 1);
    graph.points[3].radius = 1e-4 * length;
    CHECK(suspicions(usual(graph), "radii").empty());
}

TEST_CASE("every loop and every piece that nothing connects is told with its place") {
    // A square with a diagonal: two loops; and a vessel apart.
    tree::Graph graph;
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {50, 0, 0}, {53, 0, 0}})
        graph.points.push_back({p, 1.0});
    graph.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {4, 5}};
    const auto tree = usual(graph);
    CHECK(tree.loop_count == 2);
    const auto loops = suspicions(tree, "loops");
    REQUIRE(loops.size() == 2);
    for (const tree::Note& loop : loops) {
        CHECK(loop.at->x >= 0.0);
        CHECK(loop.at->x <= 10.0);
    }
    const auto pieces = suspicions(tree, "pieces");
    REQUIRE(pieces.size() == 1); // the longest is the tree itself
    CHECK(pieces[0].at->x >= 50.0);
    CHECK(pieces[0].text.find("1 branch, 3 mm") != std::string::npos);
    SUBCASE("a piece of each system is none") {
        graph.systems = {{"artery", {}}, {"vein", {}}};
        graph.point_systems = {0, 0, 0, 0, 1, 1};
        CHECK(suspicions(usual(graph), "pieces").empty());
    }
}

TEST_CASE("notes are grouped by kind and topic, what is suspect first") {
    tree::VesselTree tree;
    tree.notes = {{Note::Kind::kAssumed, "units", "a", {}},
                  {Note::Kind::kRepaired, "zero-radii", "b", {}},
                  {Note::Kind::kSuspect, "units", "c", {}},
                  {Note::Kind::kRepaired, "zero-radii", "d", {}},
                  {Note::Kind::kAssumed, "axes", "e", {}}};
    const auto groups = tree::note_groups(tree);
    REQUIRE(groups.size() == 4);
    CHECK(groups[0].kind == Note::Kind::kSuspect);
    CHECK(groups[1].notes == std::vector<std::size_t>{1, 3});
    CHECK(groups[2].topic == "units");
    CHECK(groups[3].topic == "axes");
    CHECK(tree::name_of(groups[1].kind) == "repaired");
}
