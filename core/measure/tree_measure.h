// What people measure on a tree: paths along the vessels, angles between places and where vessels branch. Straight
// distances and diameters at a place are in core/measure/branch_point.h. mm and degrees.
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
    std::vector<glm::dvec3> places; // its centerline; where it begins and ends first and last
};

// The shortest way along centerlines from one place to another, through loops as well as through the hierarchy. Nothing
// when no way leads from the one to the other.
[[nodiscard]] std::optional<Path> path_between(const tree::VesselTree& tree, const BranchPlace& from,
                                               const BranchPlace& to);

// The angle at `apex` between the straight lines to two other points: 0 where they lie on one side, 180 where the three
// are in line; 0 also where a point lies at the apex.
[[nodiscard]] double angle_deg(const glm::dvec3& from, const glm::dvec3& apex, const glm::dvec3& to);

// The branching where a branch begins. Directions are chords, for the first segment alone says more about the voxels
// than about the vessel: from the branching to the place one and a half of its diameters along the centerline, or to
// the other end of a branch that is shorter.
struct Branching {
    glm::dvec3 place{0.0};
    std::optional<double> to_parent_deg;              // between the parent's way on and the branch: 0 is straight on
    std::vector<std::pair<int, double>> siblings_deg; // between the branch and each branch that begins there too
};

[[nodiscard]] Branching branching_of(const tree::VesselTree& tree, int branch);

// Unit direction of a branch where it begins, or, outward, where it ends; as a chord, see above.
[[nodiscard]] glm::dvec3 start_direction(const tree::VesselTree& tree, int branch);
[[nodiscard]] glm::dvec3 end_direction(const tree::VesselTree& tree, int branch);

// The figures of a vessel tree: what `ramus info` prints. Lengths in mm, volumes in mm3. Means of radii and diameters
// are taken along the centerline, so that a finely sampled stretch counts no more than a coarse one; the volume is that
// of the truncated cones between the points, where they overlap at forks counted twice.

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
    int leaves = 0;                         // branches with nothing behind them
    std::vector<BranchStatistics> branches; // by id
};

[[nodiscard]] TreeStatistics tree_statistics(const tree::VesselTree& tree);

} // namespace ramus::measure
