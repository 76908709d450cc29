// Trees that go through a file and must come back.
#pragma once

#include "core/io/trees/tree_file.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace ramus::test {

// What a file says about it, read again.
inline tree::VesselTree through_a_file(const tree::VesselTree& tree, const std::string& extension,
                                       const std::vector<std::string>& comments = {}) {
    const TemporaryFolder folder;
    const auto file = folder.path() / ("tree" + extension);
    REQUIRE(io::write_tree(tree, file, comments));
    auto read = io::read_tree(file);
    REQUIRE_MESSAGE(read.has_value(), (read ? std::string() : read.error().message()));
    return std::move(*read);
}

// Positions and radii to the bit, and all that hangs together.
inline void check_same_network(const tree::VesselTree& read, const tree::VesselTree& tree) {
    CHECK(read.points == tree.points);
    CHECK(read.roots == tree.roots);
    CHECK(read.loop_count == tree.loop_count);
    REQUIRE(read.branches.size() == tree.branches.size());
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        CHECK(read.branches[b].points == tree.branches[b].points);
        CHECK(read.branches[b].parent == tree.branches[b].parent);
    }
}

// A ring on a stem, a vessel of its own that passes through the ring's first point, and a ring alone.
inline tree::VesselTree rings_and_crossings() {
    tree::Graph graph;
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 0),
                                 {0, 0, 5},
                                 {4, 0, 9},
                                 {-4, 0, 9},
                                 {0, 0, 13}, // stem and ring
                                 {-9, 0, 5},
                                 {0, 0, 5},
                                 {9, 0, 5}, // crosses it
                                 {20, 0, 0},
                                 {24, 0, 0},
                                 {22, 3, 0}}) // alone
        graph.points.push_back({at, 0.1 + 0.3 * static_cast<double>(graph.points.size())});
    graph.edges = {{0, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {5, 6}, {6, 7}, {8, 9}, {9, 10}, {10, 8}};
    graph.roots = {0, 7};
    auto tree = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("g"); });
    REQUIRE(tree.has_value());
    REQUIRE(tree->loop_count == 2);
    return std::move(*tree);
}

// Whether one of its notes, of any kind, has these words.
inline bool says(const tree::VesselTree& tree, const std::string& words) {
    return std::ranges::any_of(tree.notes,
                               [&](const tree::Note& note) { return note.text.find(words) != std::string::npos; });
}

} // namespace ramus::test
