// NumberedSet: some of the numbers below a limit, a bit each, and where each of them is in ascending order.
#pragma once

#include "core/base/count_bits.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus {

class NumberedSet {
public:
    // Empty; its numbers will be less than `limit`.
    explicit NumberedSet(std::size_t limit) : words_(limit / kBits + 1, 0) {}

    // Whether it was not there yet.
    bool add(std::uint32_t number) {
        std::uint64_t& word = words_[number / kBits];
        const std::uint64_t before = word;
        word |= bit(number);
        return word != before;
    }
    // All of them, ascending. To be called after the last add() and before place().
    [[nodiscard]] std::vector<std::uint32_t> list() {
        std::vector<std::uint32_t> all;
        before_.resize(words_.size());
        for (std::size_t w = 0; w < words_.size(); ++w) {
            before_[w] = static_cast<std::uint32_t>(all.size());
            for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
                all.push_back(static_cast<std::uint32_t>(kBits * w) +
                              static_cast<std::uint32_t>(std::countr_zero(left)));
        }
        return all;
    }
    // Of one of them, in that list.
    [[nodiscard]] std::uint32_t place(std::uint32_t number) const {
        const std::uint64_t lower = words_[number / kBits] & (bit(number) - 1);
        return before_[number / kBits] + count_bits(lower);
    }

private:
    static constexpr std::size_t kBits = 64;
    static constexpr std::uint64_t bit(std::uint32_t number) { return std::uint64_t{1} << number % kBits; }

    std::vector<std::uint64_t> words_;
    std::vector<std::uint32_t> before_; // how many come before those of each word
};

} // namespace ramus
