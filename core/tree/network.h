// Network: the graph of nodes and branches of a tree, loops included, as plain arrays. For algorithms that follow all
// connections and not only the hierarchy. Built in linear time.
#pragma once

#include "core/base/grouped.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::tree {

struct Network {
    std::vector<std::array<int, 2>> ends; // by branch: its first node (at the parent's end) and its last node
    std::vector<std::uint32_t> points;    // by node: its point
    std::vector<int> roots;               // nodes where a branch without a parent begins, each once
    Grouped<int> around;                  // by node: its branches, ascending; a branch from a node to itself twice

    explicit Network(const VesselTree& tree);

    [[nodiscard]] int node_count() const { return static_cast<int>(points.size()); }
    [[nodiscard]] std::span<const int> at(int node) const { return around.of(static_cast<std::size_t>(node)); }
    // The other end of a branch.
    [[nodiscard]] int across(int branch, int node) const {
        const auto& [start, end] = ends[static_cast<std::size_t>(branch)];
        return start == node ? end : start;
    }
};

} // namespace ramus::tree
