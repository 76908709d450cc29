// Whether a fork may stand at a point: its segments must keep away from all others, except from those they meet at a
// joint nearby, and must stay inside the organ.
#pragma once

#include "core/tree/grow/organ.h"
#include "core/tree/grow/segment_grid.h"
#include "core/tree/grow/skeleton.h"

#include <span>
#include <vector>

namespace ramus::tree::growth {

// One segment of a fork: from the fork to `end`, which is the node `node` (-1: a terminal still to be added).
struct Spoke {
    int node = -1;
    Vec end{0.0};
    double radius_mm = 0.0;
    bool may_leave_organ = false; // the stem
};

class Clearance {
public:
    Clearance(const Organ& organ, const Skeleton& tree, const SegmentGrid& grid)
        : organ_(organ), tree_(tree), grid_(&grid) {}
    void use(const SegmentGrid& grid) { grid_ = &grid; }

    // `own`: the segments that the fork's spokes replace; they are not in the way.
    [[nodiscard]] bool fork_fits(const Vec& fork, std::span<const Spoke> spokes, std::span<const int> own);

private:
    struct Kin {
        int segment;
        bool from_parent_end; // entered at its parent's end
        double way_mm;        // from the fork to this end
    };
    void gather_kin(const Vec& fork, std::span<const Spoke> spokes, std::span<const int> own);
    [[nodiscard]] bool inside(const Vec& a, const Vec& b, double radius_mm) const;

    const Organ& organ_;
    const Skeleton& tree_;
    const SegmentGrid* grid_;
    std::vector<Kin> kin_;
    std::vector<int> near_;
};

} // namespace ramus::tree::growth
