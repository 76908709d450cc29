// Suggestions which branches of the portal vein supply the segments of the liver that Couinaud described (1957), by the
// order of branches, the side and the direction. Suggestions only: variants are common (every third liver has one), and
// a person must confirm each. The caudate lobe (segment 1) is never suggested, since its branches are small and many.
//
// Method: the first fork with a share of the tips on both sides divides left from right. Each half is divided further
// until no part has more than its share of the tips; each part is named by where its tips lie, seen from the middle of
// the half's: on the right 5 to 8 (anterior or posterior, inferior or superior), on the left 4 (medial), 2 (superior
// and posterior) and 3.
#pragma once

#include "core/base/error.h"
#include "core/tree/dependency.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <vector>

namespace ramus::organ {

struct SegmentSuggestion {
    int branch = tree::kNoBranch; // with all that depend on it
    int segment = 0;              // 2 to 8
    std::size_t tips = 0;         // of the branch and its dependents
};

// Of one vessel system; by segment, the branch with the most tips first. Several branches may supply one segment. Fails
// if the sides of the patient are not known or the system has no fork.
[[nodiscard]] Result<std::vector<SegmentSuggestion>> suggested_segments(const tree::VesselTree& tree,
                                                                        const tree::Dependency& dependency, int system);

} // namespace ramus::organ
