// Bends the straight segments of a grown skeleton into smooth, slightly winding centerlines and samples them evenly.
// The trunk runs through its forks without a kink, a twig leaves at its own angle. Where bending would make two vessels
// touch, or leave the organ, the branches concerned are bent less, down to straight.
#pragma once

#include "core/tree/grow/organ.h"
#include "core/tree/grow/skeleton.h"
#include "core/tree/grow/touching.h"

#include <vector>

namespace ramus::tree::growth {

struct BentTree {
    Centerlines lines;
    // Segments that touch another away from a joint, or leave the organ, though straight. The smaller one of each pair.
    std::vector<int> misplaced;
};

[[nodiscard]] BentTree bend(const Skeleton& tree, const Organ& organ, double spacing_mm, double tortuosity,
                            double joint_reach, std::uint64_t seed);

} // namespace ramus::tree::growth
