// Ends of vessels that the border of a volume cuts: the surface ends there in a flat cap in the plane of the border.
//
// The axis of such an end goes on beyond the plane, so that the vessel keeps its radius up to there. Vertices beyond
// the plane go back onto it, along the axis, and the closer to the axis the farther out they were. No two of a convex
// end come to the same place, and which triangles there are does not change: a closed surface stays closed. The rim is
// as sharp as a cell is small.
#pragma once

#include "core/field/brick_field.h"
#include "core/tree/prepare.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::field {

// How far the axis goes on, in radii: there a Gaussian of width 5 has 99 % of the radius at the plane.
inline constexpr double kBeyondCut = 0.5;

struct CutEnd {
    glm::dvec3 at{0.0}, outward{0.0}; // mm; the end of the axis, and the plane's unit normal
    glm::dvec3 along{0.0};            // the axis' unit direction, outward
    double radius = 0.0;              // mm
    int branch = tree::kNoBranch;     // id in the source tree
};

// Notes about cut ends (tree::Note::outward) that stand at ends of the tree as it is.
[[nodiscard]] std::vector<CutEnd> cut_ends_of(const tree::PreparedTree& prepared);

// Moves those of `count` vertices that lie beyond the plane of an end of their branch.
void flatten_ends(const std::vector<CutEnd>& ends, const SurfacePoints& vertices, std::size_t count);

} // namespace ramus::field
