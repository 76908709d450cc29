// Points along a branch's centerline: what the vessel is like at a fraction of its length, and how much of it lies
// between two fractions. Fractions run from 0 at the parent's end to 1, by length; radii are linear between the points,
// volumes those of the truncated cones between them. mm, mm3.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>

namespace ramus::measure {

// A place on a centerline: a branch, and where on it, of its length from the parent's end.
struct BranchPlace {
    int branch = tree::kNoBranch;
    double fraction = 0.5;
    bool operator==(const BranchPlace&) const = default;
};

// The centerline at one point of it.
struct BranchPoint {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0}; // of the segment there, outward, unit length
    double radius_mm = 0.0;
};

// `fraction` outside 0 to 1 means the nearer end.
[[nodiscard]] BranchPoint point_on(const tree::VesselTree& tree, int branch, double fraction);
[[nodiscard]] inline BranchPoint point_on(const tree::VesselTree& tree, const BranchPlace& place) {
    return point_on(tree, place.branch, place.fraction);
}

// The fraction at which the centerline of a branch is nearest to a point.
[[nodiscard]] double nearest_fraction(const tree::VesselTree& tree, int branch, const glm::dvec3& point);

struct BranchPart {
    double length_mm = 0.0;
    double volume_mm3 = 0.0;
};

// Nothing when `from` is not below `to`.
[[nodiscard]] BranchPart part_of(const tree::VesselTree& tree, int branch, double from, double to);

} // namespace ramus::measure
