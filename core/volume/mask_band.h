// MaskBand: the voxels near the boundary of a mask, two on either side along each axis, numbered row by row. Voxels
// beyond the border of the volume count as outside and can belong to the band.
#pragma once

#include "core/base/count_bits.h"
#include "core/base/large_array.h"
#include "core/volume/bit_mask.h"

#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::volume {

class MaskBand {
public:
    explicit MaskBand(const BitMask& mask); // finds and counts the voxels

    [[nodiscard]] std::size_t size() const { return size_; }

    // The numbers of the previous and next voxel along x, y and z; size() if not in the band.
    using Neighbours = std::array<std::uint32_t, 6>;
    struct Numbered {
        LargeArray<Neighbours> neighbours;
        LargeArray<std::uint8_t> inside; // 1 or 0
        // 1: within two voxels of a part or gap of the mask that is thinner than four voxels and not mere roughness.
        LargeArray<std::uint8_t> thin;
    };
    // Data of all voxels by number. The band must have fewer than 2^32 voxels.
    [[nodiscard]] Numbered numbered() const;

    // The number of a voxel, which must be in the band.
    [[nodiscard]] std::uint32_t number_of(const glm::ivec3& voxel) const { return number_at(voxel + kBeyond); }
    [[nodiscard]] bool has(const glm::ivec3& voxel) const { return band_.test(voxel + kBeyond); }
    // Calls visit(number, voxel) for each voxel, with slices in parallel.
    template <class Visit> void for_each(const Visit& visit) const {
        for_padded([&](std::uint32_t number, const glm::ivec3& at) { visit(number, at - kBeyond); });
    }

private:
    static constexpr int kBeyond = 2; // width of the padding around the volume, in voxels

    template <class Visit> void for_padded(const Visit& visit) const {
        tbb::parallel_for(0, band_.size().z, [&](int k) {
            for (int j = 0; j < band_.size().y; ++j) {
                const auto row = band_.row(j, k);
                for (std::size_t word = 0; word < row.size(); ++word)
                    for (std::uint64_t left = row[word]; left != 0; left &= left - 1) {
                        const glm::ivec3 at(static_cast<int>(64 * word) + std::countr_zero(left) - 1, j, k);
                        visit(number_at(at), at);
                    }
            }
        });
    }

    // These functions use indices in the padded volume.
    [[nodiscard]] std::size_t first_word(int j, int k) const {
        return band_.row_words() *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(band_.size().y) * static_cast<std::size_t>(k));
    }
    [[nodiscard]] std::uint32_t number_at(const glm::ivec3& padded) const {
        const auto bit = static_cast<std::size_t>(padded.x) + 1;
        const std::uint64_t word = band_.row(padded.y, padded.z)[bit / 64];
        return before_[first_word(padded.y, padded.z) + bit / 64] +
               count_bits(word & ((std::uint64_t{1} << bit % 64) - 1));
    }
    [[nodiscard]] std::uint32_t number_or_none(const glm::ivec3& padded) const {
        return band_.test(padded) ? number_at(padded) : static_cast<std::uint32_t>(size_);
    }

    BitMask padded_; // the mask with outside voxels around it
    BitMask band_;
    std::vector<std::uint32_t> before_; // by word of the band: number of voxels before it
    std::size_t size_ = 0;
};

} // namespace ramus::volume
