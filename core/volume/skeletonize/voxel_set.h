// VoxelSet: the voxels of a mask as a set that can be walked: one bit each in a box cropped to them with a border of
// outside all around, a number from 0 for each (the rank of its bit), and the bits of its 26 neighbours in one word.
// What an algorithm keeps for each voxel is an array by number, and bits are those of a SparseMask, so that memory
// follows the vessels, not the box.
#pragma once

#include "core/base/count_bits.h"
#include "core/base/large_array.h"
#include "core/volume/sparse_mask.h"

#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::volume {

// The 27 bits of a voxel and its neighbours: bit x + 3 y + 9 z with offsets 0 to 2; the voxel itself is bit 13.
using Neighbourhood = std::uint32_t;
inline constexpr int kCentreBit = 13;
inline constexpr Neighbourhood kNeighbours = ((1U << 27U) - 1U) & ~(1U << kCentreBit);

class VoxelSet {
public:
    using Address = std::uint64_t; // of a bit, of all of the box

    // Cropped to what is set. `spacing`: of the mask's voxels along its axes, mm.
    VoxelSet(const SparseMask& mask, const glm::dvec3& spacing);

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] const glm::dvec3& spacing() const { return spacing_; }
    [[nodiscard]] const SparseMask& bits() const { return bits_; }

    [[nodiscard]] Address address(const glm::ivec3& inner) const {
        return row_bits() * (static_cast<Address>(inner.y) +
                             static_cast<Address>(bits_.size().y) * static_cast<Address>(inner.z)) +
               static_cast<Address>(inner.x) + 1;
    }
    // In the cropped box, and in the mask that it came from.
    [[nodiscard]] glm::ivec3 inner(Address at) const {
        const Address row = at / row_bits();
        const auto height = static_cast<Address>(bits_.size().y);
        return {static_cast<int>(at % row_bits()) - 1, static_cast<int>(row % height), static_cast<int>(row / height)};
    }
    [[nodiscard]] glm::ivec3 voxel(Address at) const { return inner(at) + origin_; }
    [[nodiscard]] const glm::ivec3& origin() const { return origin_; }

    [[nodiscard]] bool test(Address at) const { return (bits_.word(at / 64) >> (at % 64) & 1U) != 0; }
    [[nodiscard]] std::uint32_t number(Address at) const { // of a voxel of the set
        const std::size_t place = bits_.place(at / 64);
        const std::uint64_t below = bits_.at_place(place) & ((std::uint64_t{1} << (at % 64)) - 1);
        return ranks_[place] + count_bits(below);
    }
    // Of the first voxel of the set at `at` or up to two bits behind it; there is one.
    [[nodiscard]] std::uint32_t number_from(Address at) const {
        return number(bits_.place(at / 64) == SparseMask::kNone ? (at / 64 + 1) * 64 : at);
    }
    [[nodiscard]] Address row_bits() const { return bits_.row_words() * 64; }
    [[nodiscard]] Address slice_bits() const { return row_bits() * static_cast<Address>(bits_.size().y); }

    // How far each of the 27 bits of a neighbourhood is in addresses, and in mm.
    [[nodiscard]] std::int64_t step(int bit) const {
        return bit % 3 - 1 + (bit / 3 % 3 - 1) * static_cast<std::int64_t>(row_bits()) +
               (bit / 9 - 1) * static_cast<std::int64_t>(slice_bits());
    }
    [[nodiscard]] double step_mm(int bit) const;

    // Calls `call(address, number, bit)` for every neighbour of a voxel that is in the set.
    template <class Call> void for_neighbours(Address at, const Call& call) const { for_neighbours(at, bits_, call); }
    // Of those that are in `part` too, a part of the set.
    template <class Call> void for_neighbours(Address at, const SparseMask& part, const Call& call) const;

    template <class Call> void for_each(const Call& call) const { // in order of addresses
        bits_.for_words([&](std::size_t w, std::uint64_t word) {
            for (std::uint64_t left = word; left != 0; left &= left - 1)
                call(static_cast<Address>(w) * 64 + static_cast<Address>(std::countr_zero(left)));
        });
    }

private:
    glm::ivec3 origin_{0};
    glm::dvec3 spacing_;
    SparseMask bits_;
    LargeArray<std::uint32_t> ranks_; // voxels before each word that is kept
    std::uint32_t count_ = 0;
};

// The bits around a voxel of the box (not of its border) in any mask of the same size.
[[nodiscard]] inline Neighbourhood neighbourhood(const SparseMask& mask, VoxelSet::Address at) {
    const auto row_bits = static_cast<std::int64_t>(mask.row_words() * 64);
    const std::int64_t slice_bits = row_bits * mask.size().y;
    Neighbourhood found = 0;
    for (int z = 0; z < 3; ++z)
        for (int y = 0; y < 3; ++y) {
            const auto first = static_cast<std::uint64_t>(static_cast<std::int64_t>(at) - 1 + (y - 1) * row_bits +
                                                          (z - 1) * slice_bits);
            const std::uint64_t shift = first % 64;
            std::uint64_t bits = mask.word(first / 64) >> shift;
            if (shift > 61) bits |= mask.word(first / 64 + 1) << (64 - shift);
            found |= static_cast<Neighbourhood>(bits & 7U) << (3 * y + 9 * z);
        }
    return found;
}

template <class Call> void VoxelSet::for_neighbours(Address at, const SparseMask& part, const Call& call) const {
    const Neighbourhood all = neighbourhood(bits_, at);
    const Neighbourhood wanted = &part == &bits_ ? all : neighbourhood(part, at);
    for (int row = 0; row < 9; ++row) {
        std::uint32_t left = wanted >> (3 * row) & 7U;
        if (left == 0) continue;
        const auto first = static_cast<Address>(static_cast<std::int64_t>(at) + step(3 * row));
        const std::uint32_t number_of_first = number_from(first);
        const std::uint32_t there = all >> (3 * row) & 7U;
        const std::array<std::uint32_t, 3> before{0, there & 1U, (there & 1U) + (there >> 1U & 1U)};
        for (; left != 0; left &= left - 1) { // voxels of a row have numbers in a row
            const int x = std::countr_zero(left);
            if (3 * row + x != kCentreBit)
                call(first + static_cast<Address>(x), number_of_first + before[static_cast<std::size_t>(x)],
                     3 * row + x);
        }
    }
}

} // namespace ramus::volume
