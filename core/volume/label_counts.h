// How many voxels each label of a mask has.
#pragma once

#include "core/volume/volume.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::volume {

struct LabelCount {
    std::int32_t label = 0;
    std::uint64_t voxels = 0;
    bool operator==(const LabelCount&) const = default;
};

// Voxels that two labels share.
struct SharedCount {
    std::array<std::int32_t, 2> labels{}; // ascending
    std::uint64_t voxels = 0;
    bool operator==(const SharedCount&) const = default;
};

// Every label that has a voxel, in order; none of volumes that are not whole numbers. A voxel of several labels counts
// for each of them.
[[nodiscard]] std::vector<LabelCount> label_counts(const Volume& volume);

// Every value but 0 as it is kept, in order: labels, and those that stand for several (Volume::overlaps).
[[nodiscard]] std::vector<std::int32_t> kept_values(const Volume& volume);

// Also the segments of a segmentation that have no voxel.
[[nodiscard]] std::vector<LabelCount> listed_counts(const Volume& volume);

// Every pair of labels that share voxels, in order.
[[nodiscard]] std::vector<SharedCount> shared_counts(const Volume& volume);

// Voxels with a value of at least `isovalue`.
[[nodiscard]] std::uint64_t count_from(const Volume& volume, double isovalue);

} // namespace ramus::volume
