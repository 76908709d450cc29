// Distances (mm) of vessels from lesions, and the vessels within given margins. Lesions are spheres and closed meshes.
// The distance between a lesion and a vessel's wall is the minimum of (distance of a place to the lesion) - (radius
// there) over all places of the branch's centerline, and 0 if the two overlap. This is the exact distance to the union
// of balls along the centerline, up to rounding.
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

// The distance (mm) from a point to the nearest lesion; infinite without lesions.
[[nodiscard]] double lesion_distance(const Lesions& lesions, const glm::dvec3& point);

// By branch: the distance (mm) from its wall to the nearest lesion; infinite without lesions.
[[nodiscard]] std::vector<double> wall_distances(const tree::VesselTree& tree, const Lesions& lesions);

struct BandRow {
    int branch = tree::kNoBranch;
    double distance_mm = 0.0;
    double mean_diameter_mm = 0.0;
    Amount dependents; // without the branch itself
};

// The branches of one margin: from_mm < distance <= to_mm. The first band also contains branches at distance 0.
struct Band {
    double from_mm = 0.0;
    double to_mm = 0.0;
    std::vector<BandRow> rows; // by mean diameter, the thickest first; then by id
};

// One band for each of `bands_mm` (ascending). Branches beyond the last one are in no band.
[[nodiscard]] std::vector<Band> band_table(std::span<const double> distances_mm, std::span<const double> bands_mm,
                                           const TreeStatistics& statistics, std::span<const Amount> dependents);

} // namespace ramus::measure
