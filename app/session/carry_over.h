// What becomes of marks and camera when the tree that they are about is read again in another way.
#pragma once

#include "app/session/session.h"

namespace ramus::app {

// For each branch of `before` the same one of `after`, or kNoBranch. Where both have branches of the same shape, each
// is itself; else one with ends, points and middle at the very same places.
[[nodiscard]] std::vector<int> same_branches(const tree::VesselTree& before, const tree::VesselTree& after);

struct CarriedOver {
    Marks marks;
    std::size_t lost = 0; // marks of branches that are no more
};
// `marks` on `after`: selection, states, cuts, names and measurements go with their branches, a system that is hidden
// as a whole stays so. What has a place in mm of its own stays there. Margins and limits that are the usual ones of
// `before` are those of `after`.
[[nodiscard]] CarriedOver carried_over(const Marks& marks, const tree::VesselTree& before,
                                       const tree::VesselTree& after);

// A mask that the isosurface is of, and the tree was made of, has one unit for both.
void follow_unit(Marks& marks, const TreeFile& file);

// The camera that sees `after` as `camera` sees `before`: from the same side and as large, where one is the other moved
// and scaled.
[[nodiscard]] render::Camera carried_over(const render::Camera& camera, const tree::VesselTree& before,
                                          const tree::VesselTree& after);

} // namespace ramus::app
