// Extracts some branches of a tree as a tree of their own.
#pragma once

#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>

namespace ramus::tree {

// Keeps the branches whose entry in `kept` is not 0 (by branch id; branches beyond its end are removed), with their
// points, labels, systems and data. The rest is cut into branches again: a node with two branches becomes an inner
// point of one branch. Remaining roots stay; the root of a piece without one is the start of its first branch. At least
// one branch must be kept.
[[nodiscard]] VesselTree part_of(const VesselTree& tree, std::span<const std::uint8_t> kept);

} // namespace ramus::tree
