// Finds the pairs of triangles of a surface that intersect.
#pragma once

#include "core/base/job.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ramus::mesh {

struct TrianglePair {
    std::uint32_t first = 0, second = 0; // indices of triangles; first < second
    bool operator==(const TrianglePair&) const = default;
    [[nodiscard]] bool operator<(const TrianglePair& other) const {
        return first != other.first ? first < other.first : second < other.second;
    }
};

// What a triangle is compared with: with none, with those that are compared as well and share no corner with it, or
// with all.
enum class Compared : std::uint8_t { kNot, kNotAdjacent, kWithAll };

struct IntersectionLimits {
    std::size_t pairs = std::numeric_limits<std::size_t>::max(); // the largest number of pairs to list
    // The largest number of exact comparisons per triangle, as a mean over blocks of consecutive triangles.
    std::size_t looks = std::numeric_limits<std::size_t>::max();
};

struct IntersectingTriangles {
    std::vector<TrianglePair> pairs; // ascending; empty if there are more than IntersectionLimits::pairs
    std::size_t count = 0;           // number of pairs, listed or not
    // False: some pairs are missing since IntersectionLimits::looks was exceeded somewhere, or the job was cancelled.
    bool looked_at_all = true;
};

// Of pairs that are compared (`compared`, by triangle) those that meet beyond the corners that they share
// (exact_triangles.h). Where triangles lie beside few others, takes time as the number of those that are compared. The
// same whatever the threads do, unless the job is cancelled.
[[nodiscard]] IntersectingTriangles intersecting_triangles(const TriangleBoxes& boxes,
                                                           std::span<const Compared> compared,
                                                           const IntersectionLimits& limits, Job& job);

} // namespace ramus::mesh
