// A tree made ready for a surface (pruned, smoothed), whose segments still know the branch of the file they come from:
// pruning joins branches where a twig went, and the ids that people see must stay those of the file.
#pragma once

#include "core/tree/vessel_tree.h"

namespace ramus::tree {

struct PreparedTree {
    VesselTree tree;
    // Branch id in the file's tree for every segment of `tree` (branches in order, segments along each).
    std::vector<int> segment_source;
    // The index of every segment among those of the file's tree, counted in the same way, and how many those are.
    // Empty: nothing was pruned, each has its own index.
    std::vector<std::uint32_t> segment_index;
    std::size_t source_segments = 0;
};

} // namespace ramus::tree
