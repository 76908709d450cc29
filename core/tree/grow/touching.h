// Finds where vessels touch that should not: two centerlines nearer than the sum of their radii although the way
// between the two points along the tree is long, so that no joint excuses it. Remembers the centerlines, so that after
// a change only what changed is looked at.
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
    // joint_reach: how many times the sum of the radii the way along the tree may be at a joint.
    Touching(const Skeleton& tree, const Centerlines& lines, const Organ& organ, double joint_reach);

    // Pairs of segments that touch, of which at least one is marked, each once, in ascending order. `changed` marks the
    // segments whose centerlines are not those of the call before; at first all are taken as changed.
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
    std::vector<Piece> pieces_;                                   // those of replaced centerlines stay, unused
    std::vector<std::pair<std::size_t, std::size_t>> of_segment_; // its pieces: first and one past the last
    SegmentGrid grid_;
};

} // namespace ramus::tree::growth
