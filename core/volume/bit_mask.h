// BitMask: a mask with one bit for each voxel of a volume; and inside(), which makes a mask from labels or a threshold.
// For thin structures in large volumes, SparseMask (sparse_mask.h) takes less memory.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/label_choice.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ramus::volume {

class BitMask {
public:
    explicit BitMask(const glm::ivec3& size); // all voxels outside

    [[nodiscard]] const glm::ivec3& size() const { return size_; }
    [[nodiscard]] bool test(const glm::ivec3& voxel) const; // false beyond the border of the volume
    void set(const glm::ivec3& voxel);                      // one thread at a time per row
    void clear(const glm::ivec3& voxel);                    // one thread at a time per row
    [[nodiscard]] std::uint64_t count() const;

    // The words of a row along x. Voxel i is bit (i + 1) % 64 of word (i + 1) / 64. The bit before the first voxel and
    // at least one bit after the last are 0.
    [[nodiscard]] std::size_t row_words() const { return row_words_; }
    [[nodiscard]] std::span<std::uint64_t> row(int j, int k) { return {words_.data() + first_of(j, k), row_words_}; }
    [[nodiscard]] std::span<const std::uint64_t> row(int j, int k) const {
        return {words_.data() + first_of(j, k), row_words_};
    }
    [[nodiscard]] std::span<const std::uint64_t> slice(int k) const {
        return {words_.data() + first_of(0, k), row_words_ * static_cast<std::size_t>(size_.y)};
    }

private:
    [[nodiscard]] std::size_t first_of(int j, int k) const {
        return row_words_ *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(k));
    }
    glm::ivec3 size_;
    std::size_t row_words_;
    LargeArray<std::uint64_t> words_;
};

// Which voxels of a volume are inside: those with some labels, or those with at least an isovalue. Neither: voxels that
// are not 0 for whole numbers, and voxels of at least 0.5 for fractions from 0 to 1.
struct Selection {
    std::vector<LabelChoice> labels;
    std::optional<double> isovalue;
};

// The mask of a selection. The isovalue for a volume that holds a threshold is that threshold. A voxel with several
// labels (Volume::overlaps) is inside if one of them is selected. Fails if
// - labels are selected and values are not whole numbers, or no voxel has one of the labels,
// - an isovalue is selected and labels overlap,
// - nothing is selected and the volume does not look like a mask,
// - no voxel is inside,
// - `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<BitMask> inside(const Volume& volume, const Selection& selection, const JobRange& job);

// The isovalue of the surface of `selection`. None: labels, whose surface is midway between voxels.
[[nodiscard]] std::optional<double> isovalue_of(const Volume& volume, const Selection& selection);

} // namespace ramus::volume
