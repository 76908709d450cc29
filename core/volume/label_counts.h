// Counts the voxels of each label of a mask, and of pairs of overlapping labels.
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

// The number of voxels that have two labels.
struct SharedCount {
    std::array<std::int32_t, 2> labels{}; // ascending
    std::uint64_t voxels = 0;
    bool operator==(const SharedCount&) const = default;
};

// Every label that has a voxel, ascending. A voxel with several labels counts for each. Empty for fractions.
[[nodiscard]] std::vector<LabelCount> label_counts(const Volume& volume);

// Every stored value except 0, ascending: labels, and values that stand for several labels (Volume::overlaps).
[[nodiscard]] std::vector<std::int32_t> kept_values(const Volume& volume);

// label_counts(), and with count 0 the segments of a segmentation that have no voxel.
[[nodiscard]] std::vector<LabelCount> listed_counts(const Volume& volume);

// Every pair of labels that share voxels, ascending.
[[nodiscard]] std::vector<SharedCount> shared_counts(const Volume& volume);

// The number of voxels with a value of at least `isovalue`.
[[nodiscard]] std::uint64_t count_from(const Volume& volume, double isovalue);

} // namespace ramus::volume
