// RunsOf: run-length encoded values of a mask. Vessels, organs and the background are long runs along a row, so a mask
// of several labels takes less memory than one bit for each voxel.
#pragma once

#include "core/base/mapped_pages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::volume {

template <class T> class RunsOf {
public:
    using Value = T;

    // Appends `count` equal values.
    void add(Value value, std::size_t count);

    [[nodiscard]] std::size_t size() const { return size_; } // values
    [[nodiscard]] double bytes() const { return static_cast<double>(sizeof(Run)) * static_cast<double>(runs_.size()); }
    [[nodiscard]] Value operator[](std::size_t n) const { return runs_[run_at(n)].value; }

    // Returns the memory of the runs that end before value `n` to the system. These values must not be read again.
    void release_before(std::size_t n) { empty_pages(runs_.data(), run_at(n) * sizeof(Run)); }

    // Calls `call(begin, end, value)` for all runs within [first, end), in order. A long run may be divided.
    template <class Call> void for_runs(std::size_t first, std::size_t end, const Call& call) const {
        if (first >= end) return;
        for (std::size_t r = run_at(first), at = first; at < end; ++r) {
            const std::size_t next = std::min(end_of(r, at / kBlock), end);
            call(at, next, runs_[r].value);
            at = next;
        }
    }

private:
    // A new run begins with every block, so that its begin takes two bytes, and lookups are limited to a block.
    static constexpr std::size_t kBlock = std::size_t{1} << 16U;
    struct Run {
        std::uint16_t begin; // in its block
        Value value;
    };
    [[nodiscard]] std::size_t run_at(std::size_t n) const;
    [[nodiscard]] std::size_t end_of(std::size_t run, std::size_t block) const {
        const bool is_last = run + 1 == (block + 1 < firsts_.size() ? firsts_[block + 1] : runs_.size());
        return is_last ? std::min((block + 1) * kBlock, size_) : block * kBlock + runs_[run + 1].begin;
    }

    std::vector<Run> runs_;
    std::vector<std::size_t> firsts_; // first run of each block
    std::size_t size_ = 0;
};

using VoxelRuns = RunsOf<std::uint16_t>; // of whole numbers
using FractionRuns = RunsOf<float>;

} // namespace ramus::volume
