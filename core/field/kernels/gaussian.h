// The paper's kernel (Oeltze & Preim 2005, eqs. 7-10): a Gaussian across the vessel, filtered along the segment.
//
// For a segment a -> b of length L with unit direction u, radii linear between its ends, and w = width ln 2:
//     t = (p - a) . u,   d = distance of p to the line,   r = radius at t (beyond the ends: FieldSegment)
//     h(p) = S(rho) exp(-w d^2 / r^2) * 1/2 [erf(sqrt(w) t / r) + erf(sqrt(w) (L - t) / r)]
// The surface is where the sum equals exp(-w). S fades the kernel smoothly to exactly 0 between 1.4 and 1.7 radii
// (times sqrt(5 / width)) from the segment, so that skipping distant segments changes no bit.
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// `width`: 5 is the paper's, 1 is Bloomenthal's.
[[nodiscard]] Kernel gaussian(double width);

// The squared distances between which S falls from 1 to 0, in (r / sqrt(w))^2. They do not depend on the width:
// w (1.4 sqrt(5 / width))^2 = 5 ln 2 1.4^2.
inline constexpr double kFadeBegin = 6.792841769487465; // 5 ln 2 1.4^2
inline constexpr double kFadeEnd = 10.016026079703457;  // 5 ln 2 1.7^2

// How far the surface of a long vessel reaches beyond its free end, in radii: the x at which 1/2 [1 - erf(sqrt(w) x)]
// is the isovalue exp(-w). 0.70752 at width 5, 0 at width 1. `width` must be at least 1.
[[nodiscard]] double reach_beyond_end(double width);

} // namespace ramus::field
