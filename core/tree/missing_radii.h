// Radii of points that have none, from the nearest measured radii along the vessels.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::tree {

struct FilledRadii {
    std::vector<std::uint32_t> points;         // that got a radius, in ascending order
    std::optional<std::uint32_t> out_of_reach; // a point of a vessel without any positive radius
};

// Gives every point with an edge whose radius is not positive the radius that interpolates the positive ones: linear in
// the arc length between two measured points, constant beyond the last one. Where vessels without radii fork, the
// values solve the same problem as a network of resistors whose resistance is the length of the edges. Exact where the
// points without radii form trees; an edge that closes a loop among them is not followed. Takes time in proportion to
// the number of points and edges. Points at the ends of an edge lie at different places.
[[nodiscard]] FilledRadii fill_missing_radii(std::vector<Point>& points, const std::vector<Edge>& edges);

} // namespace ramus::tree
