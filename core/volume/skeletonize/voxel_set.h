// VoxelSet: the voxels of a mask for graph algorithms. Each voxel has an address (its bit in a box that is cropped to
// the mask, with an outside border), a number from 0 (the rank of its bit), and its 26 neighbours as bits of one word.
// Algorithms store data of voxels in arrays by number, so memory is in proportion to the vessels, not to the box.
#pragma once

#include "core/base/count_bits.h"
#include "core/base/large_array.h"
#include "core/volume/sparse_mask.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::volume {

// A voxel and its neighbours as 27 bits: bit x + 3 y + 9 z with offsets from 0 to 2; the voxel itself is bit 13.
using Neighbourhood = std::uint32_t;
inline constexpr int kCentreBit = 13;
inline constexpr Neighbourhood kNeighbours = ((1U << 27U) - 1U) & ~(1U << kCentreBit);

class VoxelSet {
public:
    using Address = std::uint64_t; // index of a bit in the box

    // The box is cropped to the set voxels. `spacing`: of the mask's voxels along its axes, mm. `memory`: for arrays by
    // number of the voxel.
    VoxelSet(const SparseMask& mask, const glm::dvec3& spacing, LargeAllocator<std::byte> memory = {});

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] const glm::dvec3& spacing() const { return spacing_; }
    [[nodiscard]] const SparseMask& bits() const { return bits_; }
    [[nodiscard]] const LargeAllocator<std::byte>& memory() const { return memory_; }

    [[nodiscard]] Address address(const glm::ivec3& inner) const {
        return row_bits() * (static_cast<Address>(inner.y) +
                             static_cast<Address>(bits_.size().y) * static_cast<Address>(inner.z)) +
               static_cast<Address>(inner.x) + 1;
    }
    // The voxel at an address: its indices in the cropped box, and in the mask.
    [[nodiscard]] glm::ivec3 inner(Address at) const {
        const Address row = at / row_bits();
        const auto height = static_cast<Address>(bits_.size().y);
        return {static_cast<int>(at % row_bits()) - 1, static_cast<int>(row % height), static_cast<int>(row / height)};
    }
    [[nodiscard]] glm::ivec3 voxel(Address at) const { return inner(at) + origin_; }
    [[nodiscard]] const glm::ivec3& origin() const { return origin_; }

    [[nodiscard]] bool test(Address at) const { return (bits_.word(at / 64) >> (at % 64) & 1U) != 0; }
    [[nodiscard]] std::uint32_t number(Address at) const { // the voxel must be in the set
        const std::size_t place = bits_.place(at / 64);
        const std::uint64_t below = bits_.at_place(place) & ((std::uint64_t{1} << (at % 64)) - 1);
        return ranks_[place] + count_bits(below);
    }
    // The number of the first voxel of the set at `at` or up to two bits after it. There must be one.
    [[nodiscard]] std::uint32_t number_from(Address at) const {
        return number(bits_.place(at / 64) == SparseMask::kNone ? (at / 64 + 1) * 64 : at);
    }
    [[nodiscard]] Address row_bits() const { return bits_.row_words() * 64; }
    [[nodiscard]] Address slice_bits() const { return row_bits() * static_cast<Address>(bits_.size().y); }

    // The offset of each of the 27 bits of a neighbourhood, in addresses and in mm.
    [[nodiscard]] std::int64_t step(int bit) const {
        return bit % 3 - 1 + (bit / 3 % 3 - 1) * static_cast<std::int64_t>(row_bits()) +
               (bit / 9 - 1) * static_cast<std::int64_t>(slice_bits());
    }
    [[nodiscard]] double step_mm(int bit) const;

    // Calls `call(address, number, bit)` for every neighbour in the set.
    template <class Call> void for_neighbours(Address at, const Call& call) const { for_neighbours(at, bits_, call); }
    // The same for neighbours in `part`, a subset of the set.
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
    LargeAllocator<std::byte> memory_;
    LargeArray<std::uint32_t> ranks_; // number of voxels before each stored word
    std::uint32_t count_ = 0;
};

// The bits around a voxel in any mask of the size of the box. The voxel must not be at the border of the box.
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
        for (; left != 0; left &= left - 1) { // voxels of a row have consecutive numbers
            const int x = std::countr_zero(left);
            if (3 * row + x != kCentreBit)
                call(first + static_cast<Address>(x), number_of_first + before[static_cast<std::size_t>(x)],
                     3 * row + x);
        }
    }
}

} // namespace ramus::volume
