// Dependency: what is reached only through a branch. A branch depends on another when every way from its component's
// root to it leads through that other one: take the other one away, and no blood comes there. In a tree these are the
// descendants. In a network with loops they are fewer: whatever can be reached another way round does not depend.
//
// An edge of an undirected network lies on every way to something exactly when it is a bridge of the network, so the
// only branches with dependents are bridges, and the nearest bridge above a branch is the one it depends on first. They
// form a forest, which is kept as intervals of one order: "all that depends on B" is a span of it, at no cost.
// Built once for a tree, in nearly linear time and without recursion; the tree need not outlive it.
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

    // Whether the network falls apart there: nothing leads around this branch.
    [[nodiscard]] bool is_bridge(int branch) const { return bridge_[index(branch)] != 0; }
    // The nearest branch that this one depends on, or kNoBranch.
    [[nodiscard]] int parent(int branch) const { return parent_[index(branch)]; }
    // All that it depends on, the nearest first.
    [[nodiscard]] std::vector<int> upstream(int branch) const;

    // Whether `branch` is reached only through `other`; false for one and the same.
    [[nodiscard]] bool depends(int branch, int other) const {
        const int distance = place_[index(branch)] - place_[index(other)];
        return distance > 0 && distance < size_[index(other)];
    }
    // All that depends on it, each after what it depends on itself.
    [[nodiscard]] std::span<const int> dependents(int branch) const { return with_dependents(branch).subspan(1); }
    [[nodiscard]] std::span<const int> with_dependents(int branch) const { // itself first
        return std::span(order_).subspan(static_cast<std::size_t>(place_[index(branch)]),
                                         static_cast<std::size_t>(size_[index(branch)]));
    }
    // These branches, in any order, and all that depends on any of them: ascending, without repeats.
    [[nodiscard]] std::vector<int> with_dependents(std::span<const int> branches) const;

    // Every branch once, each after what it depends on.
    [[nodiscard]] std::span<const int> order() const { return order_; }

    bool operator==(const Dependency&) const = default;

private:
    static std::size_t index(int branch) { return static_cast<std::size_t>(branch); }
    void find_bridges(const VesselTree& tree, std::span<const int> outward);
    void number(std::span<const int> outward);

    std::vector<char> bridge_;
    std::vector<int> parent_;
    std::vector<int> order_; // a branch, then all that depends on it
    std::vector<int> place_; // of a branch in `order_`
    std::vector<int> size_;  // itself and its dependents
};

} // namespace ramus::tree
