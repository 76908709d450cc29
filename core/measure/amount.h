// Amount: the size of a part of a tree in four numbers; and the amount that depends on each branch
// (core/tree/dependency.h).
#pragma once

#include "core/measure/tree_measure.h"
#include "core/tree/dependency.h"

#include <vector>

namespace ramus::measure {

struct Amount {
    int branches = 0;
    double length_mm = 0.0;
    double volume_mm3 = 0.0; // of the truncated cones between the points
    int leaves = 0;          // branches with a free end

    Amount& operator+=(const Amount& other) {
        branches += other.branches;
        length_mm += other.length_mm;
        volume_mm3 += other.volume_mm3;
        leaves += other.leaves;
        return *this;
    }
    bool operator==(const Amount&) const = default;
};

// By branch: whether its far end is free, that is, connected to no other branch.
[[nodiscard]] std::vector<char> free_ends(const tree::VesselTree& tree);

// By branch: the amount of its dependents, without the branch itself. Linear in the number of branches.
[[nodiscard]] std::vector<Amount> dependent_amounts(const tree::VesselTree& tree, const TreeStatistics& statistics,
                                                    const tree::Dependency& dependency);

} // namespace ramus::measure
