// One lesion and the vessels around it: the shortest distance to a vessel's wall, how deep the two overlap, and how
// much of the wall the lesion touches. A vessel is the union of balls along its centerlines; its cross-section at a
// place is the circle of the radius there, square to the centerline. mm and degrees.
//
// Distances to spheres are exact. Distances to meshes are found to within a ten-thousandth of the vessel's radius.
// Angles are found to within a tenth of a degree. Not guaranteed: cross-sections where a branch begins lie partly
// inside of its parent, and count like the others.
#pragma once

#include "core/measure/lesion_distance.h"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace ramus::measure {

// A sphere or a closed mesh.
struct Lesion {
    std::array<double, 4> sphere{};           // centre and radius, where there is no mesh
    std::shared_ptr<const MeshDistance> mesh; // null: the sphere
    bool operator==(const Lesion&) const = default;
};

// mm from the lesion's surface; negative inside.
[[nodiscard]] double signed_distance(const Lesion& lesion, const glm::dvec3& point);
// The place of the lesion's surface that is nearest to a point.
[[nodiscard]] glm::dvec3 nearest_on(const Lesion& lesion, const glm::dvec3& point);

// Where a lesion and a vessel are nearest to each other, or overlap most.
struct NearestWall {
    int branch = tree::kNoBranch; // kNoBranch: there are no vessels
    double fraction = 0.0;        // of the branch's length, from the parent's end
    double distance_mm = 0.0;     // 0 where the two touch or overlap
    double overlap_mm = 0.0;      // how deep the wall goes into the lesion; 0 where the two do not overlap
    glm::dvec3 on_lesion{0.0}, on_wall{0.0};
};
[[nodiscard]] NearestWall nearest_wall(const tree::VesselTree& tree, std::span<const int> branches,
                                       const Lesion& lesion);

// The angle of a cross-section's wall that lies within the lesion, or within `touch_mm` of it: 0 to 360 degrees.
// `axis`: of unit length.
[[nodiscard]] double contact_angle_deg(const Lesion& lesion, const glm::dvec3& centre, const glm::dvec3& axis,
                                       double radius_mm, double touch_mm);

// How a lesion touches a branch.
struct WallContact {
    int branch = tree::kNoBranch; // kNoBranch: it touches none
    double angle_deg = 0.0;       // the largest of all cross-sections
    double fraction = 0.0;        // where that cross-section is
    double length_mm = 0.0;       // of the centerline whose cross-sections touch the lesion
};
[[nodiscard]] WallContact wall_contact(const tree::VesselTree& tree, int branch, const Lesion& lesion, double touch_mm);

// A lesion, and the vessels of one system.
struct LesionVessels {
    std::size_t lesion = 0; // an index
    int system = 0;         // of VesselTree::systems
    NearestWall nearest;
    WallContact contact;     // with the branch of the largest angle, the longest contact among equals
    int touched = 0;         // branches
    double touched_mm = 0.0; // of the centerlines of all branches that touch it
};

// For each of the lesions in their order, spheres first, and for each system that has branches, or all branches of a
// tree with fewer than two systems.
[[nodiscard]] std::vector<LesionVessels> lesion_vessels(const tree::VesselTree& tree, const Lesions& lesions,
                                                        double touch_mm);

} // namespace ramus::measure
