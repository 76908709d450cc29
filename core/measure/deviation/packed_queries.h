// The queries of PackedTriangles in SIMD, compiled for each instruction set. An implementation detail: use
// packed_triangles.h.
#pragma once

#include "core/measure/deviation/packed_triangles.h"

#include <cstddef>

namespace ramus::measure {

// distances[order[i]] = distance (mm) from points[order[i]] to the nearest triangle, for i < count. Fast if consecutive
// points are near each other.
void packed_distances(const PackedView& view, const glm::vec3* points, const std::uint32_t* order, std::size_t count,
                      double* distances);

// PackedTriangles::crossings(), unsorted, with the places of triangles in the leaves. Returns the number of crossings,
// and writes the first `room` of them.
std::size_t packed_crossings(const PackedView& view, const double* from, const double* direction, double length,
                             Crossing* found, std::size_t room);

// PackedTriangles::first_exit(), with the place of the triangle in the leaves.
Crossing packed_exit(const PackedView& view, const double* from, const double* direction, double after);

} // namespace ramus::measure
