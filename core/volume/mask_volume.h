// Regions as volumes: the runs of voxels in a row of a SparseMask, and a Volume that holds 1 inside a mask and 0
// outside, for code that draws or skeletonizes volumes.
#pragma once

#include "core/volume/sparse_mask.h"
#include "core/volume/volume.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::volume {

// Calls call(first, end) for each run of voxels inside the mask in a row along x, in order.
template <class Call> void for_row_runs(const SparseMask& mask, int j, int k, const Call& call) {
    if (mask.is_empty_row(j, k)) return;
    std::vector<std::uint64_t> scratch;
    const auto words = mask.row(j, k, scratch);
    const std::size_t bits = 64 * words.size();
    const auto next = [&](std::size_t from, bool inside) { // the first bit from there on that is or is not set
        for (std::size_t w = from / 64; w < words.size(); ++w) {
            std::uint64_t found = inside ? words[w] : ~words[w];
            if (w == from / 64) found &= ~std::uint64_t{0} << from % 64;
            if (found != 0) return 64 * w + static_cast<std::size_t>(std::countr_zero(found));
        }
        return bits;
    };
    for (std::size_t first = next(0, true); first < bits;) {
        const std::size_t end = next(first, false);
        call(static_cast<int>(first) - 1, static_cast<int>(end) - 1); // voxel i is bit i + 1
        first = end < bits ? next(end, true) : bits;
    }
}

// A volume of 1 and 0 at the place of `like`, of the same size as the mask, with the unit and the notes of `like`. Its
// memory is a few bytes for each run.
[[nodiscard]] Volume mask_volume(const SparseMask& mask, const Volume& like);

} // namespace ramus::volume
