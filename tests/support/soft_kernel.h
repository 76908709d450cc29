// A kernel that ramus does not have, to show that one is a file and nothing else knows about it: with rho the squared
// distance to the segment in local radii, h = (1 - rho / 1.7^2)^3, which reaches the isovalue at one radius.
#pragma once

#include "core/field/kernel.h"

namespace ramus::test {

inline constexpr double kSoftSupport = 1.7; // radii
[[nodiscard]] field::Kernel soft_kernel();

} // namespace ramus::test
