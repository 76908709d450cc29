// DisjointSets: union-find over elements numbered from 0, which can grow. The lowest element of a set represents it, so
// representatives do not depend on the order of the joins. Not thread-safe.
#pragma once

#include "core/base/large_array.h"

#include <algorithm>
#include <cstdint>

namespace ramus {

class DisjointSets {
public:
    DisjointSets() = default;
    explicit DisjointSets(std::size_t count, const LargeAllocator<std::uint32_t>& memory = {}) : stands_(memory) {
        add(count);
    }
    // Adds `count` elements, each a set of its own.
    void add(std::size_t count) {
        const std::size_t first = stands_.size();
        stands_.resize(first + count);
        for (std::size_t n = first; n < stands_.size(); ++n) stands_[n] = static_cast<std::uint32_t>(n);
    }
    // The representative of the set of `n`.
    std::uint32_t find(std::uint32_t n) {
        while (stands_[n] != n) n = stands_[n] = stands_[stands_[n]];
        return n;
    }
    // Joins two sets. False: they were one set already.
    bool join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        stands_[std::max(a, b)] = std::min(a, b);
        ++joined_;
        return true;
    }
    [[nodiscard]] std::size_t count() const { return stands_.size() - joined_; } // of sets

private:
    LargeArray<std::uint32_t> stands_; // parent of each element: lower, or the element itself if it is the lowest
    std::size_t joined_ = 0;
};

} // namespace ramus
