// Rounds the corners of centerlines and makes radii change smoothly along them. The result consists of straight pieces.
//
// At an inner point a parabola (a quadratic Bezier curve with the point as its control point) connects the two
// segments. It begins and ends at most one radius, and at most half a segment, from the point. So the curve has no
// corner, stays within the convex hull of the points of its segments, and passes each point closer than half of that
// distance. Corners of short segments stay, since the kernel rounds them. Radii follow a monotone cubic through the
// points (Fritsch and Carlson 1980): narrow places keep their radius, and no radius leaves the range of the two points
// around it. Nodes keep their positions.
#pragma once

#include "core/tree/prepare.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::tree {

// The numbers of straight pieces that replace one segment: of its half of the corner at its start, of its half of the
// corner at its end, and between the two (0 or 1). A segment whose corners both stay is one straight piece.
struct CurvePieces {
    std::uint8_t first = 0, last = 0, middle = 1;
    [[nodiscard]] std::uint32_t count() const { return std::uint32_t{first} + last + middle; }
};

// The pieces of each segment (branches in order, segments along each).
[[nodiscard]] std::vector<CurvePieces> pieces_of_curves(const VesselTree& tree);

// Replaces the segments of a tree by the pieces of its curves. `pieces`: for each segment of the file's tree, as
// `segment_index` counts them. Pieces are numbered over all segments of the file's tree, so pruning does not change
// numbers. New points have the label of the point before them, and interpolated data.
[[nodiscard]] PreparedTree along_curves(PreparedTree lines, std::span<const CurvePieces> pieces);

} // namespace ramus::tree
