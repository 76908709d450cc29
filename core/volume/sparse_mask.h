// SparseMask: a mask that stores only the words that hold voxels, for thin vessels in a large volume. Rows are as in
// BitMask. If many words hold voxels, or the volume is small, all words are stored, and a lookup is as fast as in a
// BitMask.
#pragma once

#include "core/base/count_bits.h"
#include "core/base/large_array.h"
#include "core/volume/bit_mask.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace ramus::volume {

class SparseMask {
public:
    static constexpr std::size_t kNone = ~std::size_t{0};

    // kAllIfFew: all words of a small volume, for fast lookups. kFilled: only words that hold voxels, unless a fourth
    // of them do.
    enum class Words { kAllIfFew, kFilled };

    // Collects words in ascending order; the last one may be added several times.
    class Builder {
    public:
        explicit Builder(const glm::ivec3& size);
        void add(std::size_t word, std::uint64_t bits) {
            if (bits == 0) return;
            if (words_.empty() || word != last_) begin(word);
            words_.back() |= bits;
        }
        [[nodiscard]] SparseMask finish(Words stored = Words::kAllIfFew) &&;

    private:
        void begin(std::size_t word);
        glm::ivec3 size_;
        std::size_t last_ = 0;
        std::vector<std::uint32_t> filled_; // of each group: a bit for each word that holds voxels
        std::vector<std::uint64_t> words_;
    };

    explicit SparseMask(const glm::ivec3& size); // all voxels outside
    explicit(false) SparseMask(const BitMask& mask);

    [[nodiscard]] const glm::ivec3& size() const { return size_; }
    [[nodiscard]] std::size_t row_words() const { return row_words_; }
    [[nodiscard]] std::size_t first_of(int j, int k) const { // first word of a row
        return row_words_ *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(k));
    }
    [[nodiscard]] bool test(const glm::ivec3& voxel) const; // false beyond the border of the volume
    [[nodiscard]] std::uint64_t count() const;

    // The index of a word among the stored words. kNone: it is 0 and not stored. Copies store the same words.
    [[nodiscard]] std::size_t place(std::size_t word) const {
        if (groups_ == nullptr) return word;
        const Group& group = (*groups_)[word / kGroup];
        const std::uint32_t bit = std::uint32_t{1} << word % kGroup;
        return (group.filled & bit) == 0 ? kNone : group.first + count_bits(group.filled & (bit - 1));
    }
    [[nodiscard]] std::size_t places() const { return words_.size(); }
    [[nodiscard]] std::uint64_t at_place(std::size_t place) const { return words_[place]; }
    [[nodiscard]] std::uint64_t word(std::size_t word) const {
        const std::size_t found = place(word);
        return found == kNone ? 0 : words_[found];
    }
    // The word must be stored.
    void set_bit(std::uint64_t at) { words_[place(at / 64)] |= std::uint64_t{1} << at % 64; }
    void clear_bit(std::uint64_t at) { words_[place(at / 64)] &= ~(std::uint64_t{1} << at % 64); }
    void clear_bits(std::size_t place, std::uint64_t bits) { words_[place] &= ~bits; }

    // Calls call(word, bits) for every word that is not 0, in ascending order.
    template <class Call> void for_words(const Call& call) const;
    [[nodiscard]] bool is_empty_row(int j, int k) const;
    // The words of a row. Copied to `scratch` if not all of them are stored.
    [[nodiscard]] std::span<const std::uint64_t> row(int j, int k, std::vector<std::uint64_t>& scratch) const;

private:
    static constexpr std::size_t kGroup = 32; // words
    struct Group {
        std::uint32_t first = 0;  // place of the first stored word
        std::uint32_t filled = 0; // a bit for each stored word
    };

    glm::ivec3 size_;
    std::size_t row_words_;
    std::shared_ptr<const LargeArray<Group>> groups_; // null: all words are stored
    LargeArray<std::uint64_t> words_;
};

template <class Call> void SparseMask::for_words(const Call& call) const {
    if (groups_ == nullptr) {
        for (std::size_t w = 0; w < words_.size(); ++w)
            if (words_[w] != 0) call(w, words_[w]);
        return;
    }
    std::size_t place = 0;
    for (std::size_t g = 0; g < groups_->size(); ++g)
        for (std::uint32_t left = (*groups_)[g].filled; left != 0; left &= left - 1, ++place)
            if (words_[place] != 0) call(g * kGroup + static_cast<std::size_t>(std::countr_zero(left)), words_[place]);
}

[[nodiscard]] BitMask bit_mask_of(const SparseMask& mask); // the same voxels

// inside() (bit_mask.h) with another result type.
[[nodiscard]] Result<SparseMask> inside_sparsely(const Volume& volume, const Selection& selection, const JobRange& job);

} // namespace ramus::volume
