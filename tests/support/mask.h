// Masks that tests make: from a rule, or of the border of another by chance.
#pragma once

#include "core/volume/bit_mask.h"
#include "core/volume/sparse_mask.h"

#include <glm/mat4x4.hpp>
#include <random>

namespace ramus::test {

// The same voxels.
inline volume::BitMask bits_of(const volume::SparseMask& mask) {
    volume::BitMask bits(mask.size());
    mask.for_words([&](std::size_t w, std::uint64_t word) {
        const auto height = static_cast<std::size_t>(mask.size().y);
        const std::size_t row = w / mask.row_words();
        bits.row(static_cast<int>(row % height), static_cast<int>(row / height))[w % mask.row_words()] = word;
    });
    return bits;
}

// What `is_inside(voxel)` says of every voxel.
template <class Rule> volume::BitMask mask_of(const glm::ivec3& size, const Rule& is_inside) {
    volume::BitMask mask(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                if (is_inside(glm::ivec3(i, j, k))) mask.set({i, j, k});
    return mask;
}

inline glm::dmat4 voxels_of(const glm::dvec3& spacing) {
    glm::dmat4 to_patient(1.0);
    for (int axis = 0; axis < 3; ++axis) to_patient[axis][axis] = spacing[axis];
    return to_patient;
}

// `part` of the voxels on both sides of the wall are what they were not.
inline volume::BitMask with_noise(const volume::BitMask& mask, double part, unsigned seed) {
    std::mt19937 random(seed);
    std::bernoulli_distribution flips(part);
    return mask_of(mask.size(), [&](const glm::ivec3& voxel) {
        const bool inside = mask.test(voxel);
        bool border = false;
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = voxel;
                next[axis] += step;
                border |= mask.test(next) != inside;
            }
        return border && flips(random) ? !inside : inside;
    });
}

} // namespace ramus::test
