// EditGraph: a tree as points and links, which edits change and assembled() turns into a tree again. Each link knows
// the branch that it comes from, so that names and colours of branches can be transferred.
#pragma once

#include "core/tree/build_tree.h"
#include "core/tree/edit_tree.h"

#include <cstdint>
#include <vector>

namespace ramus::tree {

struct EditLink {
    std::uint32_t a = 0, b = 0; // points
    int source = kNoBranch;     // the branch that it comes from
};

struct EditGraph {
    std::vector<Point> points;
    std::vector<int> labels;  // per point, or empty
    std::vector<int> systems; // per point
    DataArrays point_data;
    std::vector<EditLink> links; // branches in order, along each
    std::vector<std::uint32_t> roots;

    explicit EditGraph(const VesselTree& tree);

    // Adds a point at `share` of the way from `a` to `b`, with the label of `a`.
    std::uint32_t add_point_between(std::uint32_t a, std::uint32_t b, double share);
    // By point: the lowest point of the connected piece that contains it.
    [[nodiscard]] std::vector<std::uint32_t> pieces() const;
    [[nodiscard]] std::vector<int> degrees() const;
    // The point at a fraction of the length of a branch of `tree`; added if there is none. The links of the branch must
    // not have been changed.
    [[nodiscard]] std::uint32_t point_at(const VesselTree& tree, int branch, double fraction);

    // Builds the tree, with the systems, notes and other data of `before`. The root of a piece without a root is its
    // thickest end. Removes points that no link uses. At least one link is required.
    [[nodiscard]] EditedTree assembled(const VesselTree& before) &&;
};

} // namespace ramus::tree
