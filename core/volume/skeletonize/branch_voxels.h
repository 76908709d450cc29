// BranchVoxels: assigns each voxel of a mask to a line of its skeleton, that is a future branch: the line that the
// steepest ascent of the distance to the outside reaches (Thinned::uphill). The lines divide the mask without gap or
// overlap, and vessels that touch keep their own voxels. Exception: a piece of one voxel has no line.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/thin.h"
#include "core/volume/skeletonize/voxel_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::volume {

class BranchVoxels {
public:
    struct Member {
        VoxelSet::Address at;
        std::uint32_t point; // of the line, where the ascent ends: 0 is its node `from`, then its points, then `to`
    };

    // `thinned`: of `set`; `graph`: of its skeleton. Voxels of pruned lines belong to the nearest line of the skeleton.
    BranchVoxels(const VoxelSet& set, const Thinned& thinned, const VoxelGraph& graph);

    // The voxels of a line, in the order of their addresses.
    [[nodiscard]] std::span<const Member> of(std::size_t line) const {
        return {members_.data() + firsts_[line], firsts_[line + 1] - firsts_[line]};
    }

private:
    LargeArray<Member> members_;
    std::vector<std::size_t> firsts_;
};

} // namespace ramus::volume
