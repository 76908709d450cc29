// Grouped: values by the number of their group, in one array where the values of a group are adjacent (a counting sort;
// the layout of compressed sparse rows).
#pragma once

#include "core/base/large_array.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

namespace ramus {

template <class T> class Grouped {
public:
    Grouped() = default;
    // `for_each(put)` must call put(group, value) for every value. It is called twice and must make the same calls both
    // times. Within a group the values keep the order of the calls.
    template <class ForEach>
    Grouped(std::size_t groups, const ForEach& for_each, const LargeAllocator<std::byte>& memory = {})
        : first_(groups + 1, 0, memory), things_(memory) {
        for_each([&](std::size_t group, const T&) { ++first_[group + 1]; });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        things_.resize(first_.back());
        LargeArray<std::uint32_t> next(first_.begin(), first_.end() - 1, memory);
        for_each([&](std::size_t group, const T& thing) { things_[next[group]++] = thing; });
    }
    // All values, group by group, and the index of the first one of a group.
    [[nodiscard]] std::span<const T> all() const { return things_; }
    [[nodiscard]] std::uint32_t first(std::size_t group) const { return first_[group]; }
    [[nodiscard]] std::span<T> of(std::size_t group) {
        return std::span(things_).subspan(first_[group], first_[group + 1] - first_[group]);
    }
    [[nodiscard]] std::span<const T> of(std::size_t group) const {
        return std::span(things_).subspan(first_[group], first_[group + 1] - first_[group]);
    }

private:
    LargeArray<std::uint32_t> first_; // of each group, and one past the last
    LargeArray<T> things_;
};

} // namespace ramus
