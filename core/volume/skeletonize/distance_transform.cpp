#include "core/volume/skeletonize/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::volume {

namespace {

// Squared distances along a run of voxels: the least of across[m] + (step (n - m))^2 over all m, and of the outside
// voxels at both ends of the run. `across`: the squared distances from the previous axes.
void sweep(const std::vector<float>& across, float step, std::vector<float>& least) {
    const auto count = static_cast<int>(across.size());
    least.resize(across.size());
    for (int n = 0; n < count; ++n) {
        const auto to_end = static_cast<float>(std::min(n + 1, count - n)) * step;
        float best = std::min(across[static_cast<std::size_t>(n)], to_end * to_end);
        // Stops when voxels farther away cannot be nearer than the best so far.
        for (int away = 1; away < count; ++away) {
            const float along = static_cast<float>(away) * step;
            if (along * along >= best) break;
            if (n >= away) best = std::min(best, across[static_cast<std::size_t>(n - away)] + along * along);
            if (n + away < count) best = std::min(best, across[static_cast<std::size_t>(n + away)] + along * along);
        }
        least[static_cast<std::size_t>(n)] = best;
    }
}

struct Line {
    std::vector<float> across, least;
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint64_t> row, before; // words
};

// Sweeps all runs along y or z. A run begins at a voxel whose predecessor along the axis is outside.
void sweep_all(const VoxelSet& set, LargeArray<float>& squared, int axis) {
    const SparseMask& bits = set.bits();
    const VoxelSet::Address stride = axis == 1 ? set.row_bits() : set.slice_bits();
    const auto step = static_cast<float>(set.spacing()[axis]);
    tbb::enumerable_thread_specific<Line> lines;
    tbb::parallel_for(1, bits.size().z - 1, [&](int k) {
        Line& line = lines.local();
        for (int j = 1; j + 1 < bits.size().y; ++j) {
            if (bits.is_empty_row(j, k)) continue;
            const auto row = bits.row(j, k, line.row);
            const auto before = axis == 1 ? bits.row(j - 1, k, line.before) : bits.row(j, k - 1, line.before);
            for (std::size_t w = 0; w < row.size(); ++w)
                for (std::uint64_t begins = row[w] & ~before[w]; begins != 0; begins &= begins - 1) {
                    line.across.clear(), line.numbers.clear();
                    VoxelSet::Address at =
                        set.address({-1, j, k}) + w * 64 + static_cast<VoxelSet::Address>(std::countr_zero(begins));
                    for (; set.test(at); at += stride) {
                        line.numbers.push_back(set.number(at));
                        line.across.push_back(squared[line.numbers.back()]);
                    }
                    sweep(line.across, step, line.least);
                    for (std::size_t n = 0; n < line.numbers.size(); ++n) squared[line.numbers[n]] = line.least[n];
                }
        }
    });
}

} // namespace

LargeArray<float> distances_to_outside(const VoxelSet& set) {
    LargeArray<float> squared(set.count(), set.memory());
    const SparseMask& bits = set.bits();
    const auto step = static_cast<float>(set.spacing().x);
    tbb::enumerable_thread_specific<Line> lines;
    tbb::parallel_for(1, bits.size().z - 1, [&](int k) {
        for (int j = 1; j + 1 < bits.size().y; ++j) {
            if (bits.is_empty_row(j, k)) continue;
            const auto row = bits.row(j, k, lines.local().row);
            for (std::size_t w = 0; w < row.size(); ++w)
                for (std::uint64_t begins = row[w] & ~(row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0)); begins != 0;
                     begins &= begins - 1) {
                    const VoxelSet::Address at =
                        set.address({-1, j, k}) + w * 64 + static_cast<VoxelSet::Address>(std::countr_zero(begins));
                    const std::uint32_t first = set.number(at);
                    std::uint32_t count = 1;
                    while (set.test(at + count)) ++count;
                    for (std::uint32_t n = 0; n < count; ++n) {
                        const float away = static_cast<float>(std::min(n + 1, count - n)) * step;
                        squared[first + n] = away * away;
                    }
                }
        }
    });
    sweep_all(set, squared, 1);
    sweep_all(set, squared, 2);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, squared.size(), 1 << 14), [&](const auto& range) {
        for (std::size_t n = range.begin(); n != range.end(); ++n) squared[n] = std::sqrt(squared[n]);
    });
    return squared;
}

} // namespace ramus::volume
