// Dependency: which branches lose their blood supply when a branch is removed. Branch A depends on branch B if every
// path from the root of the component to A passes through B. In a tree the dependents of B are its descendants. In a
// network with loops there are fewer, since a branch that can be reached around B does not depend on B.
//
// Only bridges of the network have dependents, and every branch depends first on the nearest bridge above it. So the
// dependencies form a forest. It is stored as intervals of one order, in which the dependents of B are a span.
// Construction takes nearly linear time and no recursion. The tree need not outlive the object.
#pragma once

#include "core/tree/vessel_tree.h"

#include <span>
#include <vector>

namespace ramus::tree {

class Dependency {
public:
    Dependency() = default;
    explicit Dependency(const VesselTree& tree);

    [[nodiscard]] int branch_count() const { return static_cast<int>(parent_.size()); }

    // Whether the removal of this branch disconnects the network.
    [[nodiscard]] bool is_bridge(int branch) const { return bridge_[index(branch)] != 0; }
    // The nearest branch that this one depends on, or kNoBranch.
    [[nodiscard]] int parent(int branch) const { return parent_[index(branch)]; }
    // All branches that this one depends on, the nearest first.
    [[nodiscard]] std::vector<int> upstream(int branch) const;

    // Whether `branch` depends on `other`; false if they are equal.
    [[nodiscard]] bool depends(int branch, int other) const {
        const int distance = place_[index(branch)] - place_[index(other)];
        return distance > 0 && distance < size_[index(other)];
    }
    // All dependents of a branch. Each one follows the branches that it depends on.
    [[nodiscard]] std::span<const int> dependents(int branch) const { return with_dependents(branch).subspan(1); }
    [[nodiscard]] std::span<const int> with_dependents(int branch) const { // the branch itself first
        return std::span(order_).subspan(static_cast<std::size_t>(place_[index(branch)]),
                                         static_cast<std::size_t>(size_[index(branch)]));
    }
    // The given branches (in any order) and all their dependents: ascending, without repeats.
    [[nodiscard]] std::vector<int> with_dependents(std::span<const int> branches) const;

    // Every branch once. Each one follows the branches that it depends on.
    [[nodiscard]] std::span<const int> order() const { return order_; }

    bool operator==(const Dependency&) const = default;

private:
    static std::size_t index(int branch) { return static_cast<std::size_t>(branch); }
    void find_bridges(const VesselTree& tree, std::span<const int> outward);
    void number(std::span<const int> outward);

    std::vector<char> bridge_;
    std::vector<int> parent_;
    std::vector<int> order_; // each branch is followed by its dependents
    std::vector<int> place_; // by branch: its index in `order_`
    std::vector<int> size_;  // by branch: the number of its dependents, plus 1
};

} // namespace ramus::tree
