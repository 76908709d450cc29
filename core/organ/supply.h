// Supply: which branch of a tree supplies (or drains) each voxel of an organ: the nearest one, by a rule. All distances
// are exact, from voxel centres to the tree's segments.
//
// By default the visible tip of each branch that ends in the organ counts as a site of its own that reaches further
// than the axis, since beyond it lie the branches that the scan does not show; and an axis reaches the less far, the
// thicker it is, since thick vessels pass through. On grown organs, whose true supply is known, this rule has the
// smallest errors of those compared (docs/VALIDATION.md).
//
// Method: the value of each site (a segment or a tip) changes by at most the distance that one moves. A block of voxels
// therefore needs only those sites whose value in its middle is within twice its half diagonal of the least one. Blocks
// are halved, with ever fewer sites, down to a few dozen voxels, which are compared with all sites that are left.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/organ/organ.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ramus::organ {

enum class Rule : std::uint8_t {
    kTips, // the least of: distance to an axis plus axis_back radii; distance to a tip minus tip_reach radii
    kAxis, // the least distance to an axis
    kWall, // the least distance to a wall, negative inside: of the round cone of each segment
};
[[nodiscard]] std::string_view name_of(Rule rule); // "tips", "axis", "wall"
[[nodiscard]] std::optional<Rule> rule_named(std::string_view name);

struct SupplyOptions {
    Rule rule = Rule::kTips;
    // Radii; on grown organs errors hardly change from 6 to 9, and from 3 to 8.
    double tip_reach = 6.0, axis_back = 4.0;
};

// By voxel of the organ.
struct Supply {
    std::vector<std::int32_t> branch; // of equally near ones that with the lowest id
    std::vector<float> at;            // the place on it: fraction of its length from the parent's end
};

// `excluded`: by branch id, not 0: it supplies nothing itself (a trunk outside of the organ, the stem); empty: none.
// Segments without an organ voxel within their radius and a voxel's diagonal supply nothing either. Fails if no segment
// is left, and when cancelled (what == "cancelled").
[[nodiscard]] Result<Supply> supply_of(const Organ& organ, const tree::VesselTree& tree, const SupplyOptions& options,
                                       std::span<const std::uint8_t> excluded, const JobRange& job);

// By point of the tree, not 0: an organ voxel lies within its radius and a voxel's diagonal.
[[nodiscard]] std::vector<std::uint8_t> points_in(const Organ& organ, const tree::VesselTree& tree);

} // namespace ramus::organ
