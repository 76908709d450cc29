// Closes vessels that the border of a volume cuts with flat caps in the plane of the border. Lengths are in mm.
//
// The axis of a cut end is extended beyond the plane, so that the vessel keeps its radius up to the plane. Vertices
// beyond the plane are projected onto it along the axis, and moved toward the axis the farther out they were. On a
// convex end no two vertices coincide afterwards. Triangles do not change, so a closed surface stays closed. The rim of
// the cap is as sharp as the cells are small.
#pragma once

#include "core/field/brick_field.h"
#include "core/tree/prepare.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::field {

// The length of the extension, in radii. With it the Gaussian of width 5 has 99 % of the radius at the plane.
inline constexpr double kBeyondCut = 0.5;

struct CutEnd {
    glm::dvec3 at{0.0}, outward{0.0}; // mm; the end of the axis, and the plane's unit normal
    glm::dvec3 along{0.0};            // the axis' unit direction, outward
    double radius = 0.0;              // mm
    int branch = tree::kNoBranch;     // id in the source tree
};

// The cut ends of a tree, from its notes (tree::Note::outward). Ignores notes that are not at an end of the tree.
[[nodiscard]] std::vector<CutEnd> cut_ends_of(const tree::PreparedTree& prepared);

// Moves the vertices that lie beyond the plane of a cut end of their branch into the plane, and sets their normals.
void flatten_ends(const std::vector<CutEnd>& ends, const SurfacePoints& vertices, std::size_t count);

} // namespace ramus::field
