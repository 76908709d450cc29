// Certainty: how right territories are on average, by the number of branches that are visible in the organ and the
// number of territories. An estimate from grown organs, whose true supply is known (docs/VALIDATION.md, "Territories");
// a patient's organ can differ, and a single territory can be worse than the mean.
#pragma once

#include "core/organ/organ.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace ramus::organ {

struct Certainty {
    double dice = 0.0;          // mean over the territories
    double error_percent = 0.0; // of their volumes, mean of the absolute values
};

// For territories of one vessel system by Rule::kTips. Between the numbers that were measured it is interpolated, by
// their logarithms; above 1,000 branches that of 1,000 is returned. None: fewer than 60 branches, or not 2 to 8
// territories.
[[nodiscard]] std::optional<Certainty> expected_certainty(std::size_t visible_branches, std::size_t territories);

// The branches with a point in the organ (points_in()), of the systems whose entry is not 0.
[[nodiscard]] std::size_t visible_branches(const Organ& organ, const tree::VesselTree& tree,
                                           std::span<const std::uint8_t> systems);

} // namespace ramus::organ
