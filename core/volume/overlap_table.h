// OverlapTable: numbers for sets of labels, so that one whole number for each voxel also says which voxels belong to
// several segments. A voxel of one label has the label's number; a set of two or more labels has a number of its own
// above all labels. Masks, counts and marching cubes see such a volume like any other: only the choice of labels looks
// the sets up.
#pragma once

#include "core/base/error.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ramus::volume {

class OverlapTable {
public:
    // Sets are numbered from `first` on, which is above every label.
    explicit OverlapTable(std::int32_t first) : first_(first) {}

    // The value of a voxel that has `value` so far (0: no label), and now belongs to `label`, too. Fails when there are
    // more than 4,096 different sets, or more than 64 labels at one voxel: no person draws such segments, and pairs of
    // them could not be listed.
    [[nodiscard]] Result<std::int32_t> with(std::int32_t value, std::int32_t label);

    // Gives `volume` the sets that have a voxel, and its range without them.
    void finish(Volume& volume) &&;

private:
    [[nodiscard]] Result<std::int32_t> find(std::int32_t value, std::int32_t label);

    std::int32_t first_;
    std::vector<Overlap> sets_;                            // set i has the value first_ + i
    std::unordered_map<std::uint64_t, std::int32_t> next_; // of a value and a label
};

} // namespace ramus::volume
