// Computes radii for the kernel such that the surface has the radii of the tree (--radii exact). A kernel averages over
// its surroundings: where the radius changes over a length of a few radii, the surface is wider or narrower than the
// tree. The kernel radii compensate for this, as a sharpening filter does.
//
// Method: each branch is treated as straight and alone. At places at most half a radius apart, the radius of the
// surface is computed and compared with the tree's. Each point is then corrected by the weighted mean of the errors
// around; the weights are the contributions of its segments to the field at these places. So mainly the wide parts next
// to a narrow place become narrower, since they fill it. The number of iterations is fixed.
//
// Guarantees: nodes keep their radius, and points near nodes most of it, since other branches blend in there. A branch
// whose surface has an error below kAmiss everywhere keeps all of its radii. Kernel radii are between kNarrowest and
// kWidest of the tree's radii. The radii of a branch do not depend on other branches, and a radius does not depend on
// points beyond some radii, to the last bit. Not guaranteed: the radius where it changes with a slope above about 1,
// which no sum of kernels can follow.
#pragma once

#include "core/field/kernel.h"
#include "core/tree/prepare.h"

namespace ramus::field {

inline constexpr double kNarrowest = 0.4, kWidest = 1.25; // in radii of the tree
inline constexpr double kAmiss = 0.001;                   // tolerated error, in radii

// Returns the tree with `kernel_radii` filled in for this kernel.
[[nodiscard]] tree::PreparedTree with_kernel_radii(tree::PreparedTree prepared, const Kernel& kernel);

} // namespace ramus::field
