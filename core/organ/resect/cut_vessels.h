// The vessels that resections cut, and what cutting them costs: a vessel loses its connection beyond the place where it
// passes the surface, and so do the voxels of the organ beyond it, also those that stay.
#pragma once

#include "core/measure/branch_point.h"
#include "core/measure/cuts.h"
#include "core/organ/organ.h"
#include "core/organ/resect/resection.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::organ {

struct CutVessel {
    measure::BranchPlace place;
    std::size_t resection = 0; // whose surface it passes
    glm::dvec3 at{0.0};        // mm
    double diameter_mm = 0.0;  // of the vessel there
    double angle_deg = 0.0;    // between the vessel and the surface: 90 is straight across
    bool in_organ = false;     // an organ voxel lies within the vessel's radius and a voxel's diagonal
};

// The vessels that removing all that depends on cuts does not cut elsewhere: those in front of the cuts, and those
// behind them, which are lost as a whole. For Around::spared. By branch id, 1: it is spared.
[[nodiscard]] std::vector<std::uint8_t> spared_by(const tree::VesselTree& tree, std::span<const measure::Cut> cuts);

// The vessel at a cut, straight across.
[[nodiscard]] CutVessel vessel_at(const tree::VesselTree& tree, const measure::Cut& cut);

// Sorts as vessels_cut() does.
void sort_vessels(std::vector<CutVessel>& vessels);

// All places where a centerline passes the surface of the union of the resections, exact to 1e-9 mm. The thickest
// first; then by branch and place. Two places of one vessel within 0.01 mm of each other may be missed.
[[nodiscard]] std::vector<CutVessel> vessels_cut(const Organ& organ, const tree::VesselTree& tree,
                                                 std::span<const Resection> resections);

// The cuts of these vessels, for lost_spans(): of those in the organ.
[[nodiscard]] std::vector<measure::Cut> cuts_of(std::span<const CutVessel> vessels);

} // namespace ramus::organ
