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

// The triangles with which a triangle is compared. kNot: none. kNotAdjacent: the triangles that are not kNot and share
// no corner with it. kWithAll: all triangles.
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

// The compared pairs of triangles that intersect beyond their common corners (exact_triangles.h). `compared`: by
// triangle. If triangles have few others nearby, takes time proportional to the number of compared triangles. The
// result is the same for any number of threads, unless the job is cancelled.
[[nodiscard]] IntersectingTriangles intersecting_triangles(const TriangleBoxes& boxes,
                                                           std::span<const Compared> compared,
                                                           const IntersectionLimits& limits, Job& job);

} // namespace ramus::mesh
