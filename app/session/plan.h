// Plan: what follows from the lesions, the cuts and the limits of a session, for panels, commands, reports and
// pictures. All of it is derived; Document::plan() keeps it until one of the marks it follows from changes.
#pragma once

#include "app/session/lesion_meshes.h"
#include "app/session/session.h"
#include "core/measure/cuts.h"
#include "core/measure/lesion_distance.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct TreeFacts;

struct Plan {
    measure::Lesions lesions;                              // spheres, and the meshes that could be read
    std::vector<std::shared_ptr<const LesionMesh>> meshes; // by Marks::lesion_meshes; null: could not be read
    std::vector<std::string> troubles;                     // why not, a sentence each
    std::vector<double> lesion_distances_mm;               // by branch id, to the wall; empty without lesions
    std::vector<measure::Band> bands;                      // of Planning::bands_mm; empty without lesions
    measure::CutReport cuts;                               // of Marks::cuts; `spans` are what pictures draw as lost
    bool measuring = false;                                // distances are still to come: see plan_so_far()
};

// Cuts and lesions of branches that the tree does not have must not be among the marks. Meshes are read, and distances
// to them take their time (a tenth of a second for ten thousand triangles); those of `before`, an earlier plan of the
// same tree, are taken over when the lesions are the same. May be null.
[[nodiscard]] Plan make_plan(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                             const Plan* before = nullptr);

// The same without waiting: no file is read, and distances to meshes that `before` does not have are left out.
[[nodiscard]] Plan plan_so_far(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                               const Plan* before);

// Whether both lead to the same plan of one tree.
[[nodiscard]] bool same_plan(const Marks& a, const Marks& b);

} // namespace ramus::app
