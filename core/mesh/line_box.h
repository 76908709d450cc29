// Intersection test of a line segment and an axis-aligned box.
#pragma once

#include "core/base/bounds.h"

#include <algorithm>
#include <glm/vec3.hpp>

namespace ramus::mesh {

// Whether the segment from `from` to `to` has a point in the box.
[[nodiscard]] inline bool line_meets_box(const glm::dvec3& from, const glm::dvec3& to, const Bounds<glm::dvec3>& box) {
    double begin = 0.0, end = 1.0; // shares of the line
    for (int axis = 0; axis < 3; ++axis) {
        const double along = to[axis] - from[axis];
        if (along == 0.0) {
            if (from[axis] < box.least[axis] || from[axis] > box.most[axis]) return false;
            continue;
        }
        const double low = (box.least[axis] - from[axis]) / along, high = (box.most[axis] - from[axis]) / along;
        begin = std::max(begin, std::min(low, high)), end = std::min(end, std::max(low, high));
    }
    return begin <= end;
}

} // namespace ramus::mesh
