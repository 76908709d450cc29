// How many voxels each label of a mask has.
#pragma once

#include "core/volume/volume.h"

#include <cstdint>
#include <vector>

namespace ramus::volume {

struct LabelCount {
    std::int32_t label = 0;
    std::uint64_t voxels = 0;
    bool operator==(const LabelCount&) const = default;
};

// Every value but 0 of a volume of whole numbers, in order; none of other volumes.
[[nodiscard]] std::vector<LabelCount> label_counts(const Volume& volume);

// Voxels with a value of at least `isovalue`.
[[nodiscard]] std::uint64_t count_from(const Volume& volume, double isovalue);

} // namespace ramus::volume
