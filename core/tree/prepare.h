// Prepares a tree for a surface (pruning), or for a short-lived preview (thinning).
#pragma once

#include "core/tree/centerline.h"
#include "core/tree/vessel_tree.h"

namespace ramus::tree {

// A tree that is ready for a surface (pruned, smoothed). Its segments know their branch in the file's tree: pruning
// joins branches where a twig was removed, but the ids that people see must remain those of the file.
struct PreparedTree {
    VesselTree tree;
    // Branch id in the file's tree for every segment of `tree` (branches in order, segments along each).
    std::vector<int> segment_source;
    // By segment of `tree`: its index among the segments of the file's tree, counted in the same way, whose number is
    // `source_segments`. Empty if nothing was pruned: then every segment keeps its own index.
    std::vector<std::uint32_t> segment_index;
    std::size_t source_segments = 0;
    Centerline centerline = Centerline::kLines;
    // By point: the radius for the kernel, if it differs from the tree's (core/field/kernel_radii.h); otherwise empty.
    std::vector<double> kernel_radii{};
};

// Pruning of short leaf branches: the spurs that the thinning of a mask leaves (after Hahn et al. 2001, the paper's
// [6]).
//
// Removes a leaf branch if its length < ratio x the length of its parent branch. A node that keeps two branches becomes
// an inner point of one branch. Repeats until nothing is removed. Root branches stay. ratio <= 0 keeps all branches.
// Points that no branch uses are removed.
[[nodiscard]] PreparedTree prune(const VesselTree& tree, double ratio);

// A tree with fewer points, for previews.
//
// Branches keep both ends, and those inner points that lie at least `spacing` local radii beyond the last kept one.
// Points that no branch uses stay in the list.
[[nodiscard]] VesselTree thinned(VesselTree tree, double spacing);

} // namespace ramus::tree
