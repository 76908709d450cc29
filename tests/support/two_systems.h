// A tree of two vessel systems that come near each other.
#pragma once

#include "core/tree/build_tree.h"

#include <doctest/doctest.h>
#include <string>
#include <utility>

namespace ramus::test {

// A portal vein, branch 0, that forks into 1 and 2, and a hepatic vein, branch 3, that passes the trunk 2 mm from its
// axis; all 2 mm thick in radius, so that the two overlap.
inline tree::VesselTree two_systems() {
    tree::Graph graph;
    graph.points = {{{-10, 0, 0}, 2.0}, {{0, 0, 0}, 2.0},     {{10, 8, 0}, 2.0},
                    {{10, -8, 0}, 2.0}, {{-10, 0, 2.0}, 2.0}, {{20, 0, 2.0}, 2.0}};
    graph.edges = {{0, 1}, {1, 2}, {1, 3}, {4, 5}};
    graph.roots = {0, 4};
    graph.systems = {{"portal vein", {60, 110, 180}}, {"hepatic vein", {200, 80, 60}}};
    graph.point_systems = {0, 0, 0, 0, 1, 1};
    auto tree = tree::build_tree(std::move(graph), tree::Repair::kUsual, [](std::uint32_t) { return std::string(); });
    REQUIRE_MESSAGE(tree, (tree ? "" : tree.error().message()));
    return std::move(*tree);
}

} // namespace ramus::test
