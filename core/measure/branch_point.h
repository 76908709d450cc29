// Position, direction and radius at a fraction of a branch, and length and volume between two fractions. Fractions are
// of the branch's length, from 0 at the parent's end to 1. Radii are linear between the points; volumes are those of
// the truncated cones between them. Units: mm, mm3.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>

namespace ramus::measure {

// A place on a centerline: a branch and a fraction.
struct BranchPlace {
    int branch = tree::kNoBranch;
    double fraction = 0.5;
    bool operator==(const BranchPlace&) const = default;
};

// A point of a centerline.
struct BranchPoint {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0}; // unit direction of its segment, away from the parent's end
    double radius_mm = 0.0;
};

// `fraction` is clamped to 0 to 1.
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

// The part of a branch between two fractions; zeros unless from < to.
[[nodiscard]] BranchPart part_of(const tree::VesselTree& tree, int branch, double from, double to);

} // namespace ramus::measure
