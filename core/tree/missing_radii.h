// Interpolates missing radii from measured radii along the vessels.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::tree {

struct FilledRadii {
    std::vector<std::uint32_t> points;         // points that got a radius, ascending
    std::optional<std::uint32_t> out_of_reach; // a point of a vessel without any positive radius
};

// Gives every point that has an edge and no positive radius an interpolated one: linear in the arc length between two
// measured points, constant beyond the last one. Where vessels without radii fork, the radii are the potentials of a
// network of resistors whose resistances are the lengths of the edges. Exact if the points without radii form trees; an
// edge that closes a loop among them is ignored. Takes linear time. The two points of an edge must have different
// positions.
[[nodiscard]] FilledRadii fill_missing_radii(std::vector<Point>& points, const std::vector<Edge>& edges);

} // namespace ramus::tree
