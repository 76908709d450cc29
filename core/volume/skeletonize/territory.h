// Which voxels belong to which line of a skeleton: those from which the steepest way up ends on it. The volume of a
// vessel is divided among its lines without gap or overlap, and where vessels touch each keeps its own.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/thin.h"
#include "core/volume/skeletonize/voxel_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::volume {

class Territories {
public:
    struct Member {
        VoxelSet::Address at;
        std::uint32_t point; // of the line, where the way up ends: 0 is `from`, then its points, then `to`
    };

    // `thinned`: of `set`; `graph`: of its skeleton. What was pruned from the graph belongs to the line that is nearest
    // along the skeleton.
    Territories(const VoxelSet& set, const Thinned& thinned, const VoxelGraph& graph);

    [[nodiscard]] std::span<const Member> of(std::size_t line) const {
        return {members_.data() + firsts_[line], firsts_[line + 1] - firsts_[line]};
    }

private:
    LargeArray<Member> members_;
    std::vector<std::size_t> firsts_;
};

} // namespace ramus::volume
