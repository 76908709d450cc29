// BoxTree: boxes in the order in which they are given, and boxes around ever more of these. Boxes that come after each
// other should lie beside each other; then it takes time as the number of boxes found to find those that meet another.
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

    // Of the lowest level.
    [[nodiscard]] Box box(std::size_t place) const {
        return levels_.front()[place / EightBoxes::kCount].box(place % EightBoxes::kCount);
    }
    // Calls call(place) for the boxes of the lowest level that meet this one, ascending.
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
