// Centerlines whose corners are rounded, with radii that change smoothly along them, cut into straight pieces.
//
// At an inner point a parabola (a quadratic Bezier curve with the point as its control point) leads from one segment to
// the next. It begins and ends on the segments, a radius from the point or half a segment, whichever is less: so the
// curve has no corner, is nowhere outside of the hull of its segments' points, and passes each point closer than
// half of that distance. Corners that the kernel rounds by itself, those of short segments, stay. Radii follow a
// monotone cubic through the points (Fritsch and Carlson 1980): narrow places keep their radius, and nothing becomes
// narrower or wider than its points say. Nodes stay where they are.
#pragma once

#include "core/tree/prepare.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::tree {

// The pieces that follow a segment's curve: on the corner where it begins, on the one where it ends, and a straight one
// between the two. One straight piece where both corners stay.
struct CurvePieces {
    std::uint8_t first = 0, last = 0, middle = 1;
    [[nodiscard]] std::uint32_t count() const { return std::uint32_t{first} + last + middle; }
};

// Of each segment (branches in order, segments along each).
[[nodiscard]] std::vector<CurvePieces> pieces_of_curves(const VesselTree& tree);

// The tree along its curves. `pieces`: for each segment of the file's tree, as `segment_index` counts them. Pieces of a
// segment are numbered one after the other, whatever pruning leaves of the others. New points have the label of the
// point before them, and interpolated data.
[[nodiscard]] PreparedTree along_curves(PreparedTree lines, std::span<const CurvePieces> pieces);

} // namespace ramus::tree
