// BitMask: which voxels of a volume are inside, one bit each: an eighth of what the smallest volume takes.
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
    explicit BitMask(const glm::ivec3& size); // nothing set

    [[nodiscard]] const glm::ivec3& size() const { return size_; }
    [[nodiscard]] bool test(const glm::ivec3& voxel) const; // outside of everything beyond the border too
    void set(const glm::ivec3& voxel);                      // one thread at a time per row
    void clear(const glm::ivec3& voxel);                    // likewise
    [[nodiscard]] std::uint64_t count() const;

    // A row along x in words, one bit of outside before the first voxel and at least one behind the last: voxel i is
    // bit (i + 1) % 64 of word (i + 1) / 64.
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

// What of a volume is inside: some labels, or what is at least an isovalue. Neither: every voxel that is not 0 when
// values are whole numbers, 0.5 and more when they are fractions from 0 to 1.
struct Selection {
    std::vector<LabelChoice> labels;
    std::optional<double> isovalue;
};

// Voxels of several labels are inside each of them. Fails when labels are asked of values that are not whole numbers,
// when one of them is not there, when an isovalue is asked of labels that overlap, when nothing or no default is a
// sensible choice, when nothing is inside, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<BitMask> inside(const Volume& volume, const Selection& selection, const JobRange& job);

// The isovalue of a surface of `selection`; none for labels, whose surface runs midway between voxels.
[[nodiscard]] std::optional<double> isovalue_of(const Volume& volume, const Selection& selection);

} // namespace ramus::volume
