// Network: how the branches of a tree hang together at their ends, loops included, as plain arrays of numbers: what
// walks along every way through a tree, and not only along its hierarchy, needs. Built in linear time.
#pragma once

#include "core/base/grouped.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::tree {

struct Network {
    std::vector<std::array<int, 2>> ends; // by branch: the node where it begins (the parent's end) and where it ends
    std::vector<std::uint32_t> points;    // by node: its point
    std::vector<int> roots;               // nodes where a branch without a parent begins, each once
    Grouped<int> around;                  // branches at each node, ascending; one that begins and ends there twice

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
