// Measures one lesion against the vessels around it: the shortest distance to a vessel's wall, the depth of their
// overlap, and the part of the wall that the lesion touches. A vessel is the union of balls along its centerlines; its
// cross-section at a place is the circle of the local radius, perpendicular to the centerline. Units: mm and degrees.
//
// Distances to spheres are exact; distances to meshes have an error below 1e-4 of the vessel's radius; angles have an
// error below 0.1 degrees. Not guaranteed: where a branch begins, cross-sections lie partly inside the parent, and
// count like others.
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
    std::array<double, 4> sphere{};           // centre and radius; used if there is no mesh
    std::shared_ptr<const MeshDistance> mesh; // null: the sphere
    bool operator==(const Lesion&) const = default;
};

// The distance (mm) of a point from the lesion's surface; negative inside.
[[nodiscard]] double signed_distance(const Lesion& lesion, const glm::dvec3& point);
// The point of the lesion's surface that is nearest to a point.
[[nodiscard]] glm::dvec3 nearest_on(const Lesion& lesion, const glm::dvec3& point);

// The place where a lesion and a vessel are nearest to each other, or overlap most.
struct NearestWall {
    int branch = tree::kNoBranch; // kNoBranch: there are no vessels
    double fraction = 0.0;        // of the branch's length, from the parent's end
    double distance_mm = 0.0;     // 0 if the two touch or overlap
    double overlap_mm = 0.0;      // depth of the wall inside the lesion; 0 if the two do not overlap
    glm::dvec3 on_lesion{0.0}, on_wall{0.0};
};
[[nodiscard]] NearestWall nearest_wall(const tree::VesselTree& tree, std::span<const int> branches,
                                       const Lesion& lesion);

// The angle (0 to 360 degrees) of the part of a cross-section's wall that lies inside the lesion, or within `touch_mm`
// of it. `axis` must have unit length.
[[nodiscard]] double contact_angle_deg(const Lesion& lesion, const glm::dvec3& centre, const glm::dvec3& axis,
                                       double radius_mm, double touch_mm);

// The contact of a lesion with a branch.
struct WallContact {
    int branch = tree::kNoBranch; // kNoBranch: no contact
    double angle_deg = 0.0;       // the largest angle of all cross-sections
    double fraction = 0.0;        // the place of that cross-section
    double length_mm = 0.0;       // length of centerline whose cross-sections touch the lesion
};
[[nodiscard]] WallContact wall_contact(const tree::VesselTree& tree, int branch, const Lesion& lesion, double touch_mm);

// A lesion, and the vessels of one system.
struct LesionVessels {
    std::size_t lesion = 0; // index, spheres first
    int system = 0;         // index into VesselTree::systems
    NearestWall nearest;
    WallContact contact;     // with the branch of the largest angle; among equals, of the longest contact
    int touched = 0;         // number of branches that touch the lesion
    double touched_mm = 0.0; // their total length of contact
};

// One entry for each lesion (spheres first) and each system with branches. A tree with fewer than two systems counts as
// one system.
[[nodiscard]] std::vector<LesionVessels> lesion_vessels(const tree::VesselTree& tree, const Lesions& lesions,
                                                        double touch_mm);

} // namespace ramus::measure
