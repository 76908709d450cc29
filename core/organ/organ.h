// Organ: the voxels of an organ in a mask, numbered in the order of the volume (x fastest). Results about an organ are
// arrays by that number, so that they take no memory for the rest of the volume.
#pragma once

#include "core/base/bounds.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/volume/bit_mask.h"
#include "core/volume/volume.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::organ {

class Organ {
public:
    // `to_patient`: from voxel indices to mm (RAS), invertible.
    Organ(volume::BitMask mask, const glm::dmat4& to_patient);

    [[nodiscard]] const volume::BitMask& mask() const { return mask_; }
    [[nodiscard]] const glm::dmat4& to_patient() const { return to_patient_; }
    [[nodiscard]] const glm::ivec3& size() const { return mask_.size(); }
    [[nodiscard]] std::size_t count() const { return row_starts_.back(); } // voxels of the organ
    [[nodiscard]] double voxel_ml() const;
    [[nodiscard]] double volume_ml() const { return static_cast<double>(count()) * voxel_ml(); }
    // The number of the first voxel of row (j, k), or of the next row that has one.
    [[nodiscard]] std::size_t row_start(int j, int k) const {
        return row_starts_[static_cast<std::size_t>(j) +
                           static_cast<std::size_t>(size().y) * static_cast<std::size_t>(k)];
    }
    // Calls call(voxel, number) for each voxel of the organ whose indices are in [from, to), in ascending order.
    template <class Call> void for_voxels(const glm::ivec3& from, const glm::ivec3& to, const Call& call) const;
    // Calls it for the voxels whose centres are in a box of places (mm), and for some around that box.
    template <class Call> void for_voxels_near(const Bounds<glm::dvec3>& box, const Call& call) const;
    template <class Call> void for_voxels(const Call& call) const { for_voxels(glm::ivec3(0), size(), call); }
    [[nodiscard]] glm::dvec3 centre_mm(const glm::ivec3& voxel) const {
        return glm::dvec3(to_patient_ * glm::dvec4(glm::dvec3(voxel), 1.0));
    }

private:
    volume::BitMask mask_;
    glm::dmat4 to_patient_;
    std::vector<std::size_t> row_starts_; // by row; then the number of all voxels
};

// The organ of a mask. Fails as volume::inside() does.
[[nodiscard]] Result<Organ> organ_of(const volume::Volume& volume, const volume::Selection& selection,
                                     const JobRange& job);

// The voxels of each connected part (by faces), the largest first.
[[nodiscard]] std::vector<std::size_t> part_sizes(const Organ& organ);
// By voxel: the number of its part, in that order; of parts with equally many voxels, that of the lowest voxel first.
[[nodiscard]] std::vector<std::uint32_t> parts_of_voxels(const Organ& organ);
// The largest of these parts as an organ of its own; of equally large ones the first.
[[nodiscard]] Organ largest_part(const Organ& organ);

template <class Call> void Organ::for_voxels_near(const Bounds<glm::dvec3>& box, const Call& call) const {
    const glm::dmat4 to_voxels = glm::inverse(to_patient_);
    Bounds<glm::dvec3> indices;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1) != 0 ? box.most.x : box.least.x, (corner & 2) != 0 ? box.most.y : box.least.y,
                            (corner & 4) != 0 ? box.most.z : box.least.z);
        indices.hold(glm::dvec3(to_voxels * glm::dvec4(at, 1.0)));
    }
    const glm::dvec3 end(size());
    for_voxels(glm::ivec3(glm::clamp(glm::ceil(indices.least), glm::dvec3(0.0), end)),
               glm::ivec3(glm::clamp(glm::floor(indices.most) + 1.0, glm::dvec3(0.0), end)), call);
}

template <class Call> void Organ::for_voxels(const glm::ivec3& from, const glm::ivec3& to, const Call& call) const {
    if (from.x >= to.x) return;
    // Voxel i is bit i + 1 of a row.
    const auto first = static_cast<std::size_t>(from.x + 1), last = static_cast<std::size_t>(to.x);
    const std::uint64_t above = ~std::uint64_t{0} << first % 64, below = ~std::uint64_t{0} >> (63 - last % 64);
    for (int k = from.z; k < to.z; ++k)
        for (int j = from.y; j < to.y; ++j) {
            const auto row = mask_.row(j, k);
            std::size_t number = row_start(j, k);
            for (std::size_t w = 0; w < first / 64; ++w) number += static_cast<std::size_t>(std::popcount(row[w]));
            number += static_cast<std::size_t>(std::popcount(row[first / 64] & ~above));
            for (std::size_t w = first / 64; w <= last / 64; ++w) {
                std::uint64_t left = row[w];
                if (w == first / 64) left &= above;
                if (w == last / 64) left &= below;
                for (; left != 0; left &= left - 1)
                    call(glm::ivec3(static_cast<int>(64 * w) - 1 + std::countr_zero(left), j, k), number++);
            }
        }
}

} // namespace ramus::organ
