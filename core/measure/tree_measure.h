// Measurements on a tree: paths along the vessels, angles between places, angles at branchings, and totals of the tree.
// core/measure/branch_point.h has positions and diameters. Units: mm and degrees.
#pragma once

#include "core/measure/branch_point.h"
#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace ramus::measure {

struct Path {
    double length_mm = 0.0;
    std::vector<int> branches;      // from the first to the last, both included
    std::vector<glm::dvec3> places; // its centerline, from the first place to the last
};

// The shortest path along centerlines from one place to another, through loops, too. Nothing if the places are not
// connected.
[[nodiscard]] std::optional<Path> path_between(const tree::VesselTree& tree, const BranchPlace& from,
                                               const BranchPlace& to);

// The angle at `apex` between the directions to two other points, 0 to 180; 0 if one of them equals the apex.
[[nodiscard]] double angle_deg(const glm::dvec3& from, const glm::dvec3& apex, const glm::dvec3& to);

// The branching at the start of a branch. Directions are chords from the branching to the place one and a half
// diameters along the centerline, or to the other end of a shorter branch. The first segment alone would reflect the
// voxels more than the vessel.
struct Branching {
    glm::dvec3 place{0.0};
    std::optional<double> to_parent_deg;              // between the parent's direction and the branch; 0: straight on
    std::vector<std::pair<int, double>> siblings_deg; // between the branch and each other branch that begins there
};

[[nodiscard]] Branching branching_of(const tree::VesselTree& tree, int branch);

// The unit direction of a branch at its start, and at its end (outward); chords as above.
[[nodiscard]] glm::dvec3 start_direction(const tree::VesselTree& tree, int branch);
[[nodiscard]] glm::dvec3 end_direction(const tree::VesselTree& tree, int branch);

// The totals of a vessel tree, as `ramus info` prints them. Lengths in mm, volumes in mm3. Means of radii and diameters
// are weighted by length, so that dense points do not count more. The volume is that of the truncated cones between the
// points; overlaps at forks count twice.

struct Range {
    double min = 0.0;
    double mean = 0.0;
    double max = 0.0;
};

struct BranchStatistics {
    double length_mm = 0.0;
    double volume_mm3 = 0.0;
    Range diameter_mm;
};

struct TreeStatistics {
    double length_mm = 0.0;
    double volume_mm3 = 0.0;
    Range radius_mm;
    int generations = 0; // the highest generation + 1
    int highest_strahler = 0;
    int leaves = 0;                         // branches with a free end
    std::vector<BranchStatistics> branches; // by id
};

[[nodiscard]] TreeStatistics tree_statistics(const tree::VesselTree& tree);

} // namespace ramus::measure
