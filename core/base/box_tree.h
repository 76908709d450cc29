// BoxTree: a bounding-volume hierarchy over boxes that are already in spatial order, eight children to a node. It finds
// all boxes that meet a query box; callers with other queries walk its levels. If consecutive boxes are near each other
// in space, a query takes time in proportion to the boxes that it finds; otherwise sort them first, or use HalvedBoxes
// (halved_boxes.h). The result is correct for any order.
#pragma once

#include "core/base/eight_boxes.h"
#include "core/base/large_array.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#include <vector>

namespace ramus {

class BoxTree {
public:
    using Level = LargeArray<EightBoxes>;
    using Box = EightBoxes::Box;

    explicit BoxTree(Level lowest) {
        levels_.push_back(std::move(lowest));
        while (levels_.back().size() > 1) {
            const Level& below = levels_.back();
            Level level = level_of(
                below.size(), [&](std::size_t n) { return below[n].around(); }, below.get_allocator());
            levels_.push_back(std::move(level));
        }
    }
    // A level with the boxes box_of(0) to box_of(count - 1), which are called in several threads.
    template <class BoxOf>
    [[nodiscard]] static Level level_of(std::size_t count, const BoxOf& box_of,
                                        const Level::allocator_type& memory = {}) {
        constexpr std::size_t kEight = EightBoxes::kCount;
        Level level((count + kEight - 1) / kEight, memory);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, level.size()), [&](const auto& range) {
            for (std::size_t eight = range.begin(); eight < range.end(); ++eight) {
                level[eight] = EightBoxes();
                for (std::size_t n = kEight * eight; n < std::min(kEight * (eight + 1), count); ++n)
                    level[eight].set(n % kEight, box_of(n));
            }
        });
        return level;
    }

    // The lowest first, the top node last. The children of node n are the nodes 8 n to 8 n + 7 of the level below.
    [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
    // The box at `place` of the lowest level, in the given order.
    [[nodiscard]] Box box(std::size_t place) const {
        return levels_.front()[place / EightBoxes::kCount].box(place % EightBoxes::kCount);
    }
    // Calls call(place) for every box of the lowest level that meets `box`, in ascending order.
    template <class Call> void for_each_meeting(const Box& box, const Call& call) const {
        if (!levels_.front().empty()) look<0>(levels_.size() - 1, 0, 0, box, call);
    }
    // Calls call(group) for every group of eight boxes, from `first` on, whose common box meets `box`, in ascending
    // order.
    template <class Call> void for_each_group_meeting(const Box& box, std::size_t first, const Call& call) const {
        if (levels_.size() > 1)
            look<1>(levels_.size() - 1, 0, first, box, call);
        else if (first < levels_.front().size() && levels_.front()[0].around().meets(box))
            call(std::size_t{0});
    }

private:
    // `first`: of the results.
    template <std::size_t kLowest, class Call>
    void look(std::size_t level, std::size_t at, std::size_t first, const Box& box, const Call& call) const {
        for (unsigned bits = levels_[level][at].meeting(box); bits != 0; bits &= bits - 1) {
            const std::size_t below = EightBoxes::kCount * at + static_cast<std::size_t>(std::countr_zero(bits));
            if constexpr (kLowest > 0)
                if (below < first >> 3 * (level - kLowest)) continue; // 3 bits of a number for each level
            if (level > kLowest)
                look<kLowest>(level - 1, below, first, box, call);
            else
                call(below);
        }
    }

    std::vector<Level> levels_; // the lowest first
};

} // namespace ramus
