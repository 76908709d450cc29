// Trees of given points.
#pragma once

#include "core/tree/build_tree.h"
#include "core/tree/prepare.h"

#include <doctest/doctest.h>
#include <utility>
#include <vector>

namespace ramus::test {

// For who cannot go on without. Its pieces stay pieces.
inline tree::VesselTree built_tree(std::vector<tree::Point> points, std::vector<tree::Edge> edges,
                                   std::vector<std::uint32_t> roots = {0}) {
    auto tree = tree::build_tree({std::move(points), {}, std::move(edges), std::move(roots), {}, {}},
                                 tree::without(tree::Repair::kUsual, tree::Repair::kOpenEnds),
                                 [](std::uint32_t) { return std::string(); });
    REQUIRE_MESSAGE(tree, (tree ? "" : tree.error().message()));
    return std::move(*tree);
}

// One vessel along these points, from the first, which is its root.
inline tree::VesselTree vessel_along(std::vector<tree::Point> points) {
    std::vector<tree::Edge> edges;
    for (std::uint32_t i = 1; i < points.size(); ++i) edges.emplace_back(i - 1, i);
    return built_tree(std::move(points), std::move(edges));
}

// One more branch, of its own number, along these points.
inline void add_branch(tree::PreparedTree& prepared, const std::vector<tree::Point>& points) {
    tree::Branch branch;
    for (const tree::Point& point : points) {
        branch.points.push_back(static_cast<std::uint32_t>(prepared.tree.points.size()));
        prepared.tree.points.push_back(point);
    }
    const auto number = static_cast<int>(prepared.tree.branches.size());
    prepared.segment_source.insert(prepared.segment_source.end(), points.size() - 1, number);
    prepared.tree.branches.push_back(branch);
}

} // namespace ramus::test
