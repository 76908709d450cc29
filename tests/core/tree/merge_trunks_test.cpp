#include "core/tree/merge_trunks.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

// One polyline after the other, with points of their own.
tree::Graph polylines(const std::vector<std::vector<glm::dvec3>>& lines) {
    tree::Graph graph;
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) {
            const auto index = static_cast<std::uint32_t>(graph.points.size());
            graph.points.push_back({line[i], 1.0 + 0.25 * static_cast<double>(index)});
            if (i > 0) graph.edges.emplace_back(index - 1, index);
        }
    return graph;
}

} // namespace

TEST_CASE("polylines are joined where they coincide: anywhere, or where one of them ends") {
    // Two vessels cross at (0, 0, 5), a third begins there.
    const auto crossing = [] {
        return polylines(
            {{{0, 0, 0}, {0, 0, 5}, {0, 0, 10}}, {{-5, 0, 5}, {0, 0, 5}, {5, 0, 5}}, {{0, 0, 5}, {0, 7, 5}}});
    };
    tree::Graph all = crossing();
    const tree::Joined anywhere = tree::join_coincident(all, false);
    CHECK(anywhere.points == 2);
    CHECK(all.points.size() == 6);
    CHECK(anywhere.first == std::vector<std::uint32_t>{0, 1, 2, 3, 5, 7});
    CHECK(all.points[1].radius == 2.5); // the largest of the three: 1.25, 2 and 2.5
    tree::Graph ends = crossing();
    CHECK(tree::join_coincident(ends, true).points == 1);
    CHECK(ends.points.size() == 7);
    CHECK(ends.edges.back() == tree::Edge{1, 6}); // the third leaves from the first
}

TEST_CASE("what two polylines trace alike is kept once") {
    tree::Graph graph = polylines({{{0, 0, 0}, {0, 0, 5}, {3, 0, 10}}, {{0, 0, 0}, {0, 0, 5}, {-3, 0, 10}}});
    const tree::Joined joined = tree::join_coincident(graph, false);
    CHECK(joined.points == 2);
    CHECK(joined.edges == 1);
    CHECK(graph.edges.size() == 3);
}

TEST_CASE("ends that single precision sets apart are at one place; points of one vessel never are") {
    const double near = 3e-6; // of an extent of 10, less than a millionth
    tree::Graph graph =
        polylines({{{0, 0, 0}, {0, 0, 5}, {0, 0, 5.0 + near}, {0, 0, 10}}, {{0, near, 10}, {0, 5, 10}}});
    CHECK(tree::join_coincident(graph, true).points == 1);
    CHECK(graph.points.size() == 5);
    CHECK(graph.edges.size() == 4);
    // A last segment that is short was traced, too.
    tree::Graph tip = polylines({{{0, 0, 0}, {0, 0, 5}, {0, 0, 10}, {0, 0, 10.0 + near}}});
    CHECK(tree::join_coincident(tip, true).points == 0);
}

TEST_CASE("points of different systems are never joined") {
    tree::Graph graph = polylines({{{0, 0, 0}, {0, 0, 5}}, {{0, 0, 5}, {0, 0, 9}}, {{0, 0, 5}, {0, 5, 5}}});
    graph.systems = {{"artery", {}}, {"vein", {}}};
    graph.point_systems = {0, 0, 1, 1, 0, 0};
    CHECK(tree::join_coincident(graph, true).points == 1);
    CHECK(graph.point_systems == std::vector<int>{0, 0, 1, 1, 0});
}

TEST_CASE("joining ends in time whatever the coordinates are") {
    for (const double size : {1e-300, 1e-30, 1e14, 1e200, HUGE_VAL})
        for (const double gap : {1e-300, 1e-20, 1.0}) {
            tree::Graph graph =
                polylines({{{0, 0, 0}, {0, 0, gap}}, {{size, 0, 0}, {size, gap, 0}}, {{0, 0, 0}, {gap, 0, 0}}});
            CHECK(tree::join_coincident(graph, true).points >= 1);
        }
}
