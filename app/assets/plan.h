// Plan: what follows from the lesions, the cuts and the limits of a session, for panels, commands, reports and
// pictures. A part of the assets (app/assets/assets.h), which make it anew when the marks it follows from change.
#pragma once

#include "app/assets/lesion_meshes.h"
#include "app/session/session.h"
#include "core/measure/cuts.h"
#include "core/measure/lesion_distance.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct Assets;

// From the wall of every branch to the nearest lesion.
struct LesionDistances {
    measure::Lesions of;
    std::vector<double> mm; // by branch id
    [[nodiscard]] bool fits(const measure::Lesions& lesions) const {
        return !mm.empty() && of.spheres == lesions.spheres && of.meshes == lesions.meshes;
    }
};

// The marks that a plan follows from; see Marks for what they mean.
struct PlannedMarks {
    std::vector<std::array<double, 4>> lesions;
    std::vector<std::string> lesion_meshes;
    std::vector<std::pair<int, double>> cuts;
    Planning planning;
    bool operator==(const PlannedMarks&) const = default;
};
[[nodiscard]] PlannedMarks planned(const Marks& marks);

struct Plan {
    PlannedMarks of;
    measure::Lesions lesions;                              // spheres, and the meshes whose distances are known
    std::vector<std::shared_ptr<const LesionMesh>> meshes; // by Marks::lesion_meshes; null: not read
    std::vector<std::string> troubles;                     // why not, a sentence each
    std::vector<double> lesion_distances_mm;               // by branch id, to the wall; empty without lesions
    std::vector<measure::Band> bands;                      // of Planning::bands_mm; empty without lesions
    measure::CutReport cuts;                               // of Marks::cuts; `spans` are what pictures draw as lost
    bool measuring = false;                                // meshes or distances to them are still to come
};

// The spheres, and the meshes that are loaded.
[[nodiscard]] measure::Lesions loaded_lesions(const Assets& assets, const Marks& marks);

// `assets` have a tree, its facts, and distances that are taken where they fit; distances to spheres alone are measured
// where they do not. Cuts and lesions of branches that the tree does not have must not be among the marks.
[[nodiscard]] Plan make_plan(const Assets& assets, const Marks& marks);

} // namespace ramus::app
