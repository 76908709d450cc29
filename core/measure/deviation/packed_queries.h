// The queries of PackedTriangles in SIMD, chosen by what the machine has. Plain arrays only: packed_triangles.h is for
// use.
#pragma once

#include "core/measure/deviation/packed_triangles.h"

#include <cstddef>

namespace ramus::measure {

// distances[order[i]] = mm from points[order[i]] to the nearest triangle, for i below `count`. Quick where each point
// is near the one before.
void packed_distances(const PackedView& view, const glm::vec3* points, const std::uint32_t* order, std::size_t count,
                      double* distances);

// As PackedTriangles::crossings(), unsorted, triangles by their number in the leaves; returns how many there are, of
// which the first `room` are written.
std::size_t packed_crossings(const PackedView& view, const double* from, const double* direction, double length,
                             Crossing* found, std::size_t room);

// As PackedTriangles::first_exit(), the triangle by its number in the leaves.
Crossing packed_exit(const PackedView& view, const double* from, const double* direction, double after);

} // namespace ramus::measure
