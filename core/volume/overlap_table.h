// OverlapTable: numbers sets of labels, so that one whole number for each voxel can express several labels. A voxel
// with one label has the label's number; each set of two or more labels gets a number above all labels. Code that does
// not choose labels can treat such a volume like any other.
#pragma once

#include "core/base/error.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ramus::volume {

class OverlapTable {
public:
    // Numbers sets from `first` on, which must be above every label.
    explicit OverlapTable(std::int32_t first) : first_(first) {}

    // The value of a voxel that had `value` (0: no label) and now also has `label`. Fails on more than 4,096 different
    // sets, or more than 64 labels at one voxel: pairs of labels could not be listed, and real files have fewer.
    [[nodiscard]] Result<std::int32_t> with(std::int32_t value, std::int32_t label);

    // Sets Volume::overlaps to the sets that have a voxel, and the range of `volume` to that of its labels.
    void finish(Volume& volume) &&;

private:
    [[nodiscard]] Result<std::int32_t> find(std::int32_t value, std::int32_t label);

    std::int32_t first_;
    std::vector<Overlap> sets_;                            // set i has the value first_ + i
    std::unordered_map<std::uint64_t, std::int32_t> next_; // cache of with(), by value and label
};

} // namespace ramus::volume
