// Plan: values derived from a session's lesions, cuts and limits, for panels, commands, reports and pictures. Part of
// the assets (app/assets/assets.h), recomputed when these marks change.
#pragma once

#include "app/assets/shapes.h"
#include "app/session/session.h"
#include "core/measure/cuts.h"
#include "core/measure/lesion_contact.h"
#include "core/measure/lesion_distance.h"
#include "render/scene/scene.h"

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct Assets;

// Distances from the wall of every branch to the nearest lesion, and from each lesion to the vessels of each system.
struct LesionDistances {
    measure::Lesions of;
    double touch_mm = 0.0;
    std::vector<double> mm; // by branch id
    std::vector<measure::LesionVessels> vessels;
    [[nodiscard]] bool fits(const measure::Lesions& lesions, double touch) const {
        return !mm.empty() && touch_mm == touch && of.spheres == lesions.spheres && of.meshes == lesions.meshes;
    }
};
[[nodiscard]] LesionDistances measure_lesions(const tree::VesselTree& tree, measure::Lesions lesions, double touch_mm);

// The marks that a plan depends on; see Marks.
struct PlannedMarks {
    std::vector<std::array<double, 4>> lesions; // spheres
    std::vector<Lesion> lesion_meshes;          // lesion_meshes()
    std::vector<std::pair<int, double>> cuts;
    Planning planning;
    bool operator==(const PlannedMarks&) const = default;
};
[[nodiscard]] PlannedMarks planned(const Marks& marks);

struct Plan {
    PlannedMarks of;
    measure::Lesions lesions;                              // spheres, and meshes whose distances are known
    std::vector<std::shared_ptr<const LesionMesh>> meshes; // by PlannedMarks::lesion_meshes; null: not read
    std::vector<std::string> troubles;                     // why meshes are not read, a sentence each
    std::vector<double> lesion_distances_mm;               // by branch id, to the wall; empty without lesions
    std::vector<measure::LesionVessels> measured_vessels;  // see LesionDistances
    // One entry per lesion with known distances and per system (or for all vessels if the tree has fewer than two
    // systems). `lesion`: index into Marks::lesions.
    std::vector<measure::LesionVessels> vessels;
    std::vector<measure::Band> bands; // of Planning::bands_mm; empty without lesions
    measure::CutReport cuts;          // of Marks::cuts; pictures draw `spans` as lost
    bool measuring = false;           // meshes or distances to them are not complete
};

// The spheres and the loaded meshes.
[[nodiscard]] measure::Lesions loaded_lesions(const Assets& assets, const Marks& marks);

// `assets` must have a tree and its facts. Uses their distances if they fit; otherwise measures distances to spheres
// only. `marks` must not refer to missing branches.
[[nodiscard]] Plan make_plan(const Assets& assets, const Marks& marks);

// The circle around a vessel that marks a cut or a measured diameter: a closed polyline, mm, RAS. `axis`: unit vector.
[[nodiscard]] std::vector<glm::dvec3> ring_around(const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm);

// Distances to lesions with meshes on a grid, for colours. Samples are exact; the interpolation error is a small part
// of the spacing, which depends on the size of the lesions and the widest margin.
struct LesionGrid {
    std::vector<std::shared_ptr<const measure::MeshDistance>> of;
    double reach_mm = 0.0;
    std::shared_ptr<const render::DistanceGrid> grid; // null: not computed
    [[nodiscard]] bool fits(const measure::Lesions& lesions, double reach) const {
        return grid && of == lesions.meshes && reach_mm == reach;
    }
};

// The largest margin that is coloured; 0 without margins.
[[nodiscard]] double widest_margin_mm(const Planning& planning);

// `lesions` must have meshes. The grid covers everything within `reach_mm` of them. Takes a third of a second on one
// core for a lesion of ten thousand triangles.
[[nodiscard]] LesionGrid distance_grid(const measure::Lesions& lesions, double reach_mm);

} // namespace ramus::app
