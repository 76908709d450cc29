// Which segments of a tree add to the field on each other's surface: found along the tree, once for all pictures.
#pragma once

#include "render/scene/centerlines.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::render::caster {

// By point: the first one at the same position. Only ends of branches can share one.
[[nodiscard]] std::vector<std::uint32_t> coincident_points(const Centerlines& lines);

// Of segment s: segments[first[s]] to segments[first[s + 1] - 1], itself first; an even number, made so by one that
// there is not (their count).
struct Neighbours {
    std::vector<std::uint32_t> first, segments;
};

// `coincident`: coincident_points() of the lines. `points`: the first point of each segment, which ends at the next
// one. Segments are joined where they have a point in common and where their points coincide. `support_radii`: how far
// a segment's kernel reaches, in radii. Vessels that pass close by without being joined there are not found.
[[nodiscard]] Neighbours find_neighbours(const Centerlines& lines, std::span<const std::uint32_t> coincident,
                                         std::span<const std::uint32_t> points, float support_radii);

} // namespace ramus::render::caster
