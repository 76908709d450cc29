// Plan: what follows from the lesions, the cuts and the limits of a session, for panels, commands, reports and
// pictures. A part of the assets (app/assets/assets.h), which make it anew when the marks it follows from change.
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

// From the wall of every branch to the nearest lesion, and from each lesion to the vessels of each system.
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

// The marks that a plan follows from; see Marks for what they mean.
struct PlannedMarks {
    std::vector<std::array<double, 4>> lesions; // the spheres
    std::vector<std::string> lesion_meshes;     // the others' files
    std::vector<std::pair<int, double>> cuts;
    Planning planning;
    bool operator==(const PlannedMarks&) const = default;
};
[[nodiscard]] PlannedMarks planned(const Marks& marks);

struct Plan {
    PlannedMarks of;
    measure::Lesions lesions;                              // spheres, and the meshes whose distances are known
    std::vector<std::shared_ptr<const LesionMesh>> meshes; // by PlannedMarks::lesion_meshes; null: not read
    std::vector<std::string> troubles;                     // why not, a sentence each
    std::vector<double> lesion_distances_mm;               // by branch id, to the wall; empty without lesions
    std::vector<measure::LesionVessels> measured_vessels;  // as LesionDistances has them
    // For each lesion whose distances are known and each system, or all vessels of a tree with fewer than two systems;
    // `lesion` is the place in Marks::lesions.
    std::vector<measure::LesionVessels> vessels;
    std::vector<measure::Band> bands; // of Planning::bands_mm; empty without lesions
    measure::CutReport cuts;          // of Marks::cuts; `spans` are what pictures draw as lost
    bool measuring = false;           // meshes or distances to them are still to come
};

// The spheres, and the meshes that are loaded.
[[nodiscard]] measure::Lesions loaded_lesions(const Assets& assets, const Marks& marks);

// `assets` have a tree, its facts, and distances that are taken where they fit; distances to spheres alone are measured
// where they do not. Cuts and lesions of branches that the tree does not have must not be among the marks.
[[nodiscard]] Plan make_plan(const Assets& assets, const Marks& marks);

// The circle that pictures draw around a vessel: where it is cut, where its diameter was measured.

// A closed polyline, mm, RAS. `axis`: of unit length.
[[nodiscard]] std::vector<glm::dvec3> ring_around(const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm);

// The distance to lesions that are meshes, on a grid, as pictures colour by it. Sampled from the exact distance;
// between the samples it is off by a small part of their spacing, which follows the size of the lesions and the widest
// margin.
struct LesionGrid {
    std::vector<std::shared_ptr<const measure::MeshDistance>> of;
    double reach_mm = 0.0;
    std::shared_ptr<const render::DistanceGrid> grid; // null: none yet
    [[nodiscard]] bool fits(const measure::Lesions& lesions, double reach) const {
        return grid && of == lesions.meshes && reach_mm == reach;
    }
};

// The distance that pictures colour by; 0 without margins.
[[nodiscard]] double widest_margin_mm(const Planning& planning);

// `lesions` have meshes; the grid covers all within `reach_mm` of them. A third of a second on one core for a lesion of
// ten thousand triangles.
[[nodiscard]] LesionGrid distance_grid(const measure::Lesions& lesions, double reach_mm);

} // namespace ramus::app
