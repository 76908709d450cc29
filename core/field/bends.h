// Radii that go into a kernel where a centerline bends, so that the surface has those of the tree there.
//
// Along an arc of curvature k, the line integral of a kernel at an offset x towards the arc's middle is that of a
// straight line over sqrt(1 - k x), for the arc is closer to what is on its inner side. To the second order in k r, and
// the first in 1 / w, the cross-section has as much area as if its radius r were larger by (k r)^2 / (16 w) of itself,
// where the logarithm of a straight vessel's field falls by w, at its surface, with the square of the distance in
// radii: width ln 2 for the Gaussian. It is a third to a half of a percent in bends of real centerlines. Points there
// get so much less.
//
// The curvature at a point is that of the chords over kChord radii before and behind it, so that small zigzags of short
// segments are none. A point beside a segment longer than its radius keeps its radius, since that segment would carry
// the change all along.
//
// Guarantees: points nearer to an end of their branch than a chord keep their radius, a branch's radii depend on no
// other branch, and those of a point not on what is farther from it than a radius. None becomes thinner than
// kThinnestInBends of the tree's.
#pragma once

#include "core/field/kernel.h"
#include "core/tree/prepare.h"

namespace ramus::field {

inline constexpr double kThinnestInBends = 0.9; // of the tree's radius

// The same tree with `kernel_radii` for this kernel.
[[nodiscard]] tree::PreparedTree thinner_in_bends(tree::PreparedTree prepared, const Kernel& kernel);

} // namespace ramus::field
