// Radii that go into a kernel so that the surface has those of the tree. A kernel takes the mean of what is around:
// where a radius changes within a few of itself, the surface is wider or narrower than the tree says, the more the
// shorter a stenosis is. Here radii are sharpened against that.
//
// A branch is looked at as if it were straight and alone. At places along it, half a radius apart, the radius of its
// surface is found and compared with the one that is wanted; each of its points then takes a share of what is amiss, as
// much as its segments add to the field there. So it is the wide parts beside a narrow place that are narrowed, where
// they fill it. That is done a fixed number of times.
//
// Guarantees: nodes keep their radius, and points near them most of it, for there other branches blend in. A branch
// whose surface is right within kAmiss everywhere keeps all of its radii. Radii stay between kNarrowest and kWidest of
// the tree's. A branch's radii depend on no other branch, and beyond some radii from a place not on what is there, to
// the last bit. Not guaranteed: the radius where a wall's slope is above one or so, for no sum of kernels has that.
#pragma once

#include "core/field/kernel.h"
#include "core/tree/prepare.h"

namespace ramus::field {

inline constexpr double kNarrowest = 0.4, kWidest = 1.25; // of the tree's radius
inline constexpr double kAmiss = 0.001;                   // of a radius

// The same tree with `kernel_radii` for this kernel.
[[nodiscard]] tree::PreparedTree with_kernel_radii(tree::PreparedTree prepared, const Kernel& kernel);

} // namespace ramus::field
