#include "core/mesh/polygonize/parts/division.h"

#include "core/base/chunked_array.h"
#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/octree/neighbours.h"

#include <algorithm>
#include <bit>
#include <glm/vector_relational.hpp>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// Estimated times, in microseconds of a core, of which only the ratios matter. From some real trees; those of bricks in
// which vessels are kept apart vary most.
constexpr double kSegment = 0.2, kBrick = 1.0, kPartedBrick = 50.0, kJoinedBrick = 4.0;

double filling(const SubtreeSize& size) {
    return kSegment * static_cast<double>(size.segments) + kBrick * size.bricks + kPartedBrick * size.parted;
}
double joining(const SubtreeSize& size) { return kJoinedBrick * size.bricks; }

double work_of(std::span<const SubtreeSize> sizes) {
    double all = 0.0;
    for (const SubtreeSize& size : sizes) all += filling(size) + joining(size);
    return all;
}

// Divides the subtrees into ranges one after the other. The work of a part is that of its range, and what it computes
// of the subtrees beyond.
class Division {
public:
    Division(const Octree& octree, std::span<const SubtreeSize> sizes, const Touching& touching)
        : octree_(octree), sizes_(sizes), touching_(touching), counted_(sizes.size()) {}

    // Consecutive subtrees for each of `count` parts, such that the part with the most work has about as little as
    // possible.
    std::vector<SubtreeRange> in_parts(std::size_t count) {
        const double all = work_of(sizes_);
        double enough = 1.01 * all, less = all / static_cast<double>(count); // sums are rounded
        for (int step = 0; step < 16; ++step) {
            const double middle = 0.5 * (less + enough);
            (ranges_of(middle).size() <= count ? enough : less) = middle;
        }
        std::vector<SubtreeRange> ranges = ranges_of(enough);
        const auto end = static_cast<std::uint32_t>(sizes_.size());
        ranges.resize(count, {end, end});
        return ranges;
    }

private:
    // As few as have no more than this work each, or one subtree.
    std::vector<SubtreeRange> ranges_of(double most) {
        std::ranges::fill(counted_, 0U);
        std::vector<SubtreeRange> ranges;
        double work = 0.0;
        for (std::uint32_t t = 0; t < sizes_.size(); ++t) {
            if (!ranges.empty()) work += work_with(t, ranges.size());
            if (ranges.empty() || (work > most && t > ranges.back().first)) {
                ranges.push_back({t, t});
                work = work_with(t, ranges.size());
            }
            ranges.back().end = t + 1;
        }
        return ranges;
    }

    // What a subtree adds to the work of a part.
    double work_with(std::uint32_t subtree, std::size_t part) {
        double more = joining(sizes_[subtree]);
        const auto count = [&](std::uint32_t t) {
            if (std::exchange(counted_[t], static_cast<std::uint32_t>(part)) != part) more += filling(sizes_[t]);
        };
        count(subtree);
        for (const std::uint32_t t : touching_.of(subtree))
            if (is_beyond(subtree, t)) count(t);
        return more;
    }

    // Joining asks for the cells at a brick's upper sides, unless the sizes of bricks change there.
    [[nodiscard]] bool is_beyond(std::uint32_t subtree, std::uint32_t other) const {
        const Subtree &a = octree_.subtrees[subtree], &b = octree_.subtrees[other];
        return glm::all(glm::greaterThan(b.corner + brick_units(b.level), a.corner));
    }

    const Octree& octree_;
    std::span<const SubtreeSize> sizes_;
    const Touching& touching_;
    std::vector<std::uint32_t> counted_; // by subtree: the number of the last part that has its work, from 1
};

} // namespace

Touching touching_each(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs, std::size_t subtrees,
                       const LargeAllocator<std::byte>& memory) {
    return {subtrees,
            [&](const auto& put) {
                for (const auto& [a, b] : pairs) put(a, b), put(b, a);
            },
            memory};
}

double share_of_work(std::span<const SubtreeSize> sizes, SubtreeRange range) {
    return work_of(sizes.subspan(range.first, range.end - range.first)) / std::max(work_of(sizes), 1e-300);
}

double share_of_bricks(std::span<const SubtreeSize> sizes, std::span<const std::uint8_t> set) {
    double bricks = 0.0, all = 0.0;
    for (std::size_t t = 0; t < sizes.size(); ++t) {
        all += sizes[t].bricks;
        if (set[t] != 0) bricks += sizes[t].bricks;
    }
    return bricks / std::max(all, 1.0);
}

void add_ring(std::vector<std::uint8_t>& set, const Touching& touching) {
    const std::vector<std::uint8_t> before = set;
    for (std::size_t t = 0; t < set.size(); ++t)
        if (before[t] != 0)
            for (const std::uint32_t beside : touching.of(t)) set[beside] = 1;
}

std::vector<SubtreeRange> divided(const Octree& octree, std::span<const SubtreeSize> sizes, const Touching& touching,
                                  std::size_t count) {
    return Division(octree, sizes, touching).in_parts(count);
}

std::vector<std::uint8_t> subtrees_to_fill(const Octree& octree, SubtreeRange own, const Touching& touching) {
    std::vector<std::uint8_t> fill(octree.subtrees.size(), 0);
    std::vector<std::uint32_t> at_border;
    for (std::uint32_t t = own.first; t < own.end; ++t) {
        fill[t] = 1;
        if (!std::ranges::all_of(touching.of(t), [&](auto beside) { return own.holds(beside); }))
            at_border.push_back(t);
    }
    ChunkedArray<Neighbourhood> neighbours;
    find_neighbours(octree, at_border, neighbours);
    for (const std::uint32_t t : at_border) {
        const Subtree& subtree = octree.subtrees[t];
        for (std::uint32_t b = subtree.first_brick; b < subtree.first_brick + subtree.brick_count; ++b) {
            const Neighbourhood& around = neighbours[b];
            for (std::uint32_t left = asked_by_joining(around); left != 0; left &= left - 1)
                fill[octree.bricks[around.brick[static_cast<std::size_t>(std::countr_zero(left))]].subtree] = 1;
        }
    }
    return fill;
}

} // namespace ramus::mesh::bricks
