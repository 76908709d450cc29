// Some branches of a tree as a tree of their own.
#pragma once

#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>

namespace ramus::tree {

// The branches that are not 0 in `kept` (by branch id; branches beyond its end go), with their points, labels and
// systems. What is left is cut into branches anew: a node with two branches becomes an inner point of one. Roots that
// are left stay; a piece that has lost its own begins where its first branch did. Something is kept.
[[nodiscard]] VesselTree part_of(const VesselTree& tree, std::span<const std::uint8_t> kept);

} // namespace ramus::tree
