// BoxTree: a bounding-volume hierarchy over boxes that are already in spatial order, eight children to a node. It finds
// all boxes that meet a query box. If consecutive boxes are near each other in space, a query takes time in proportion
// to the boxes that it finds; otherwise use HalvedBoxes (halved_boxes.h). The result is correct for any order.
#pragma once

#include "core/base/eight_boxes.h"
#include "core/base/large_array.h"

#include <bit>
#include <cstddef>
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
            Level level((below.size() + EightBoxes::kCount - 1) / EightBoxes::kCount, EightBoxes(),
                        below.get_allocator());
            for (std::size_t n = 0; n < below.size(); ++n)
                level[n / EightBoxes::kCount].set(n % EightBoxes::kCount, below[n].around());
            levels_.push_back(std::move(level));
        }
    }

    // The box at `place` of the lowest level, in the given order.
    [[nodiscard]] Box box(std::size_t place) const {
        return levels_.front()[place / EightBoxes::kCount].box(place % EightBoxes::kCount);
    }
    // Calls call(place) for every box of the lowest level that meets `box`, in ascending order.
    template <class Call> void for_each_meeting(const Box& box, const Call& call) const {
        if (!levels_.front().empty()) look(levels_.size() - 1, 0, box, call);
    }

private:
    template <class Call> void look(std::size_t level, std::size_t at, const Box& box, const Call& call) const {
        for (unsigned bits = levels_[level][at].meeting(box); bits != 0; bits &= bits - 1) {
            const std::size_t below = EightBoxes::kCount * at + static_cast<std::size_t>(std::countr_zero(bits));
            if (level > 0)
                look(level - 1, below, box, call);
            else
                call(below);
        }
    }

    std::vector<Level> levels_; // the lowest first
};

} // namespace ramus
