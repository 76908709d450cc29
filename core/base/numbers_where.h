// numbers_where(): the numbers below a count that meet a condition, found in several threads without locks.
#pragma once

#include "core/base/large_array.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus {

// Ascending. `meets(number)` is called twice for each number, in several threads.
template <class Meets>
[[nodiscard]] LargeArray<std::uint32_t> numbers_where(std::size_t count, const Meets& meets,
                                                      const LargeAllocator<std::uint32_t>& memory = {}) {
    constexpr std::size_t kBlock = std::size_t{1} << 16;
    const auto for_each_in = [&](std::size_t block, const auto& call) {
        for (std::size_t n = kBlock * block; n < std::min(kBlock * (block + 1), count); ++n)
            if (meets(static_cast<std::uint32_t>(n))) call(static_cast<std::uint32_t>(n));
    };
    std::vector<std::size_t> first((count + kBlock - 1) / kBlock + 1, 0); // of each block, and one past the last
    tbb::parallel_for(std::size_t{0}, first.size() - 1,
                      [&](std::size_t block) { for_each_in(block, [&](std::uint32_t) { ++first[block + 1]; }); });
    std::partial_sum(first.begin(), first.end(), first.begin());
    LargeArray<std::uint32_t> found(first.back(), memory);
    tbb::parallel_for(std::size_t{0}, first.size() - 1, [&](std::size_t block) {
        std::size_t at = first[block];
        for_each_in(block, [&](std::uint32_t n) { found[at++] = n; });
    });
    return found;
}

} // namespace ramus
