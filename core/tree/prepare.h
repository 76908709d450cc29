// What is done to a tree before a surface is made of it, or a picture that stands for a moment only.
#pragma once

#include "core/tree/centerline.h"
#include "core/tree/vessel_tree.h"

namespace ramus::tree {

// A tree made ready for a surface (pruned, smoothed), whose segments still know the branch of the file they come from:
// pruning joins branches where a twig went, and the ids that people see must stay those of the file.
struct PreparedTree {
    VesselTree tree;
    // Branch id in the file's tree for every segment of `tree` (branches in order, segments along each).
    std::vector<int> segment_source;
    // The index of every segment among those of the file's tree, counted in the same way, and how many those are.
    // Empty: nothing was pruned, each has its own index.
    std::vector<std::uint32_t> segment_index;
    std::size_t source_segments = 0;
    Centerline centerline = Centerline::kLines;
    // Radii that go into a kernel, by point, where those are not the tree's (core/field/exact_radii.h); else empty.
    std::vector<double> kernel_radii{};
};

// Pruning of short leaf branches: the spurs that thinning leaves behind (after Hahn et al. 2001, the paper's [6]).
//
// A leaf branch goes when its length < ratio x the length of its parent branch; a node left with two branches becomes
// an inner point of one branch; repeated until nothing goes. Root branches stay. ratio <= 0 keeps all. Points that
// belong to no branch any more are removed.
[[nodiscard]] PreparedTree prune(const VesselTree& tree, double ratio);

// Thinning: a tree with fewer points, for pictures that stand for a moment only.
//
// Branches keep both ends, and of their inner points those that lie at least `spacing` local radii beyond the last one
// kept. Points that no branch uses any more stay in the list.
[[nodiscard]] VesselTree thinned(VesselTree tree, double spacing);

} // namespace ramus::tree
