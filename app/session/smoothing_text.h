// Describes as text and JSON how far smoothing moves a tree's points (core/tree/smooth.h).
#pragma once

#include "app/session/numbers.h"
#include "core/tree/smooth.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace ramus::app {

struct Smoothing {
    int passes = 0;
    std::optional<tree::Voxels> voxels; // of the tree; none: smoothing changes nothing
    tree::Displacement moved;
};
// Smooths a copy of the tree.
[[nodiscard]] Smoothing smoothing_of(const tree::VesselTree& tree, int passes);

[[nodiscard]] std::string voxels_text(const tree::Voxels& voxels, const Lengths& lengths); // "0.781 x 0.781 x 0.7 mm"

// "voxels of 0.781 x 0.781 x 0.7 mm (estimated): points move by 0.21 mm (0.1 radii) in the median, by 0.39 mm (0.5
// radii) at most"; "none: the points are no voxels".
[[nodiscard]] std::string smoothing_text(const Smoothing& smoothing, const Lengths& lengths);

// Keys: passes, voxel_mm (three edge lengths, or null), voxel_from ("mask", "points" or null), displacement_mm and
// displacement_radii {median, max}.
[[nodiscard]] nlohmann::ordered_json smoothing_json(const Smoothing& smoothing);

} // namespace ramus::app
