// The cuts that take the supply of given voxels away (a lesion and a margin around it) and lose the least of the rest,
// for each number of cuts: more cuts lose less. A suggestion with numbers; whether a surgeon can make them it does not
// know.
//
// Method: dynamic programming on the dependencies of branches (core/tree/dependency.h). A cut of a branch is as far
// from the root as it can be: just before the first of its voxels that must go, and at its end if only its dependents
// have such voxels. The least losses of branches that hang on one branch are combined for each sum of their numbers of
// cuts.
//
// Guaranteed: no set of as many cuts of bridges loses fewer voxels. In a tree every branch is a bridge. In a network
// with loops branches that can be reached on two ways are not cut one by one: the cut is before the loop.
#pragma once

#include "core/measure/cuts.h"
#include "core/organ/supply.h"
#include "core/tree/dependency.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::organ {

struct SuggestedCuts {
    std::vector<measure::Cut> cuts; // ascending by branch
    std::size_t lost = 0;           // voxels of the functional organ that lose their supply
};

struct CutSuggestions {
    std::vector<SuggestedCuts> by_number; // ascending numbers of cuts, descending losses; all cover the same
    std::size_t covered = 0;              // voxels that must go and that the cuts take the supply of
    std::size_t out_of_reach = 0;         // voxels that must go and that no cut of a bridge reaches
};

// `supply`: of one vessel system. `targets`: by voxel, not 0: it must go. `functional`: by voxel, not 0: it counts as
// lost. `most_cuts`: at least 1.
[[nodiscard]] CutSuggestions fewest_cuts(const tree::Dependency& dependency, const Supply& supply,
                                         std::span<const std::uint8_t> targets,
                                         std::span<const std::uint8_t> functional, std::size_t most_cuts);

// By voxel of the organ, not 0: its centre is in the boxes of the voxels of `lesions`, or at most `margin_mm` from
// them. Exact. Empty: cancelled.
[[nodiscard]] std::vector<std::uint8_t> voxels_near(const Organ& organ, const Organ& lesions, double margin_mm,
                                                    const JobRange& job);

} // namespace ramus::organ
