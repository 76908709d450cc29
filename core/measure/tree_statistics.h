// The figures of a vessel tree: what `ramus info` prints. Lengths in mm, volumes in mm3. Means of radii and diameters
// are taken along the centerline, so that a finely sampled stretch counts no more than a coarse one; the volume is that
// of the truncated cones between the points, where they overlap at forks counted twice.
#pragma once

#include "core/tree/vessel_tree.h"

#include <vector>

namespace ramus::measure {

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
