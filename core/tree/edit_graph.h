// EditGraph: a tree taken apart into points and links, for edits to work on, and put together again. Links know which
// branch they come from, so that what people have said of branches can follow.
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

    // A point at `share` of the way from `a` to `b`, with the label of `a`.
    std::uint32_t add_point_between(std::uint32_t a, std::uint32_t b, double share);
    // By point: the lowest point of the piece that it belongs to.
    [[nodiscard]] std::vector<std::uint32_t> pieces() const;
    [[nodiscard]] std::vector<int> degrees() const;
    // The point at a fraction of the length of a branch of `tree`, whose links are untouched: put in where none is.
    [[nodiscard]] std::uint32_t point_at(const VesselTree& tree, int branch, double fraction);

    // The tree, with what else `before` has. A piece without a root gets its thickest end; points that no link uses are
    // gone. There is a link.
    [[nodiscard]] EditedTree assembled(const VesselTree& before) &&;
};

} // namespace ramus::tree
