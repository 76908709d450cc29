// DisjointSets: things numbered from 0, joined into sets; more may come at any time. The lowest of a set stands for it.
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
    // More things, each a set of its own.
    void add(std::size_t count) {
        const std::size_t first = stands_.size();
        stands_.resize(first + count);
        for (std::size_t n = first; n < stands_.size(); ++n) stands_[n] = static_cast<std::uint32_t>(n);
    }
    std::uint32_t find(std::uint32_t n) {
        while (stands_[n] != n) n = stands_[n] = stands_[stands_[n]];
        return n;
    }
    // Whether they were apart.
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
    LargeArray<std::uint32_t> stands_; // another of the same set, lower unless it is the lowest itself
    std::size_t joined_ = 0;
};

} // namespace ramus
