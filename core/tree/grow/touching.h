// Touching: finds vessels that touch away from their joints: two centerlines nearer than the sum of their radii,
// although the way between the two points along the tree is long. Stores the centerlines, so that after a change only
// changed segments are tested. Lengths are in mm.
#pragma once

#include "core/tree/grow/organ.h"
#include "core/tree/grow/segment_grid.h"
#include "core/tree/grow/skeleton.h"

#include <utility>
#include <vector>

namespace ramus::tree::growth {

// The samples of segment i of the skeleton from its parent's node to its own, both included; empty for the root.
using Centerlines = std::vector<std::vector<Vec>>;

class Touching {
public:
    // joint_reach: the longest way along the tree, in sums of the two radii, that counts as a joint.
    Touching(const Skeleton& tree, const Centerlines& lines, const Organ& organ, double joint_reach);

    // Pairs of segments that touch, with at least one marked segment, each once, in ascending order. `changed`:
    // segments whose centerlines differ from those of the previous call. In the first call all count as changed.
    [[nodiscard]] std::vector<std::pair<int, int>> find(const Centerlines& lines, const std::vector<bool>& changed,
                                                        const std::vector<bool>& marked);

private:
    struct Piece {
        int segment;
        Vec a;
        Vec b;
        double from_start_mm; // arc length from the segment's parent node to a
    };
    void take(const Centerlines& lines, std::size_t segment);
    [[nodiscard]] bool way_within(int a, double along_a, int b, double along_b, double limit) const;

    const Skeleton& tree_;
    double joint_reach_;
    std::vector<int> level_;
    std::vector<double> length_;
    std::vector<Piece> pieces_;                                   // pieces of replaced centerlines stay, unused
    std::vector<std::pair<std::size_t, std::size_t>> of_segment_; // its pieces: first and one past the last
    SegmentGrid grid_;
};

} // namespace ramus::tree::growth
