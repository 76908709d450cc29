// How far vessels lie from lesions, and which vessels lie within which margin. Lesions are spheres and closed meshes;
// the distance goes from the lesion's surface to the vessel's wall: the least, over all places of the branch's
// centerline, of (distance of the place to the lesion) - (radius there), and 0 where the two overlap. That is the exact
// distance to the union of balls along the centerline; for meshes it is found to within rounding.
#pragma once

#include "core/measure/amount.h"
#include "core/measure/mesh_distance.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace ramus::measure {

struct Lesions {
    std::vector<std::array<double, 4>> spheres; // centre and radius, mm
    std::vector<std::shared_ptr<const MeshDistance>> meshes;

    [[nodiscard]] bool empty() const { return spheres.empty() && meshes.empty(); }
};

// mm from the nearest lesion to a point; infinite without lesions.
[[nodiscard]] double lesion_distance(const Lesions& lesions, const glm::dvec3& point);

// By branch: mm from its wall to the nearest lesion. Infinite without lesions.
[[nodiscard]] std::vector<double> wall_distances(const tree::VesselTree& tree, const Lesions& lesions);

struct BandRow {
    int branch = tree::kNoBranch;
    double distance_mm = 0.0;
    double mean_diameter_mm = 0.0;
    Amount dependents; // without the branch itself
};

// The branches of one margin: nearer than or at `to_mm`, farther than `from_mm` (the first band holds those at 0 too).
struct Band {
    double from_mm = 0.0;
    double to_mm = 0.0;
    std::vector<BandRow> rows; // by mean diameter, the thickest first; then by id
};

// One band for each of `bands_mm` (ascending). Branches beyond the last are in none.
[[nodiscard]] std::vector<Band> band_table(std::span<const double> distances_mm, std::span<const double> bands_mm,
                                           const TreeStatistics& statistics, std::span<const Amount> dependents);

} // namespace ramus::measure
