// Which triangles of a surface meet.
#pragma once

#include "core/base/job.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ramus::mesh {

struct TrianglePair {
    std::uint32_t first = 0, second = 0; // triangles, by their places in the surface; the lower first
    bool operator==(const TrianglePair&) const = default;
    [[nodiscard]] bool operator<(const TrianglePair& other) const {
        return first != other.first ? first < other.first : second < other.second;
    }
};

// What a triangle is compared with: with none, with those that are compared as well and share no corner with it, or
// with all.
enum class Compared : std::uint8_t { kNot, kNotAdjacent, kWithAll };

struct IntersectionLimits {
    std::size_t pairs = std::numeric_limits<std::size_t>::max(); // that are listed
    // Comparisons of two triangles whose boxes meet, for some that follow each other, as many for each of them.
    std::size_t looks = std::numeric_limits<std::size_t>::max();
};

struct IntersectingTriangles {
    std::vector<TrianglePair> pairs; // ascending; none where they are more than are listed
    std::size_t count = 0;           // of pairs, listed or not
    // False: somewhere there was too much to compare, and pairs are missing there; or the job is cancelled.
    bool looked_at_all = true;
};

// Of pairs that are compared (`compared`, by triangle) those that meet beyond the corners that they share
// (exact_triangles.h). Where triangles lie beside few others, takes time as the number of those that are compared. The
// same whatever the threads do, unless the job is cancelled.
[[nodiscard]] IntersectingTriangles intersecting_triangles(const TriangleBoxes& boxes,
                                                           std::span<const Compared> compared,
                                                           const IntersectionLimits& limits, Job& job);

} // namespace ramus::mesh
