// Bends the straight segments of a grown skeleton into smooth, slightly winding centerlines and samples them evenly
// (spacing in mm). The trunk passes its forks without a corner; a twig leaves at its own angle. Where bending would
// make two vessels touch, or leave the organ, these branches are bent less, down to straight.
#pragma once

#include "core/tree/grow/organ.h"
#include "core/tree/grow/skeleton.h"
#include "core/tree/grow/touching.h"

#include <vector>

namespace ramus::tree::growth {

struct BentTree {
    Centerlines lines;
    // Straight segments that still touch another one away from a joint (the smaller one of each pair) or leave the
    // organ.
    std::vector<int> misplaced;
};

[[nodiscard]] BentTree bend(const Skeleton& tree, const Organ& organ, double spacing_mm, double tortuosity,
                            double joint_reach, std::uint64_t seed);

} // namespace ramus::tree::growth
