// The voxels next to the boundary of a mask, two on either side of it along each axis, numbered row by row. Voxels
// beyond the border of the volume are outside of the mask and belong to the band as others do.
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
    explicit MaskBand(const BitMask& mask); // counts

    [[nodiscard]] std::size_t size() const { return size_; }

    // By number, which voxels lie before and behind along x, y and z; size() for one that is not in the band.
    using Neighbours = std::array<std::uint32_t, 6>;
    struct Numbered {
        LargeArray<Neighbours> neighbours;
        LargeArray<std::uint8_t> inside; // 1 or 0
        // 1: within two voxels of a part that is thinner than four voxels and not mere roughness, or of a gap so
        // narrow.
        LargeArray<std::uint8_t> thin;
    };
    // Of a band of fewer voxels than 32 bits tell apart.
    [[nodiscard]] Numbered numbered() const;

    // The number of a voxel that is in the band.
    [[nodiscard]] std::uint32_t number_of(const glm::ivec3& voxel) const { return number_at(voxel + kBeyond); }
    [[nodiscard]] bool has(const glm::ivec3& voxel) const { return band_.test(voxel + kBeyond); }
    // Calls visit(number, voxel) for each, slices in parallel.
    template <class Visit> void for_each(const Visit& visit) const {
        for_padded([&](std::uint32_t number, const glm::ivec3& at) { visit(number, at - kBeyond); });
    }

private:
    static constexpr int kBeyond = 2; // voxels that the band may reach beyond the border of the volume

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

    // Voxels are counted from the corner of the padded volume on.
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

    BitMask padded_; // the mask, with voxels of outside around it
    BitMask band_;
    std::vector<std::uint32_t> before_; // by word of the band: voxels before its first
    std::size_t size_ = 0;
};

} // namespace ramus::volume
