// The paper's kernel (Oeltze & Preim 2005, eqs. 7-10): a Gaussian across the vessel, integrated along the segment.
//
// Of a segment a -> b of length L with unit direction u, radii linear between its ends, w = width ln 2:
//     t = (p - a) . u,   d = distance of p to the line,   r = radius at t (beyond the ends: FieldSegment)
//     h(p) = S(rho) exp(-w d^2 / r^2) * 1/2 [erf(sqrt(w) t / r) + erf(sqrt(w) (L - t) / r)]
// and the surface is where the sum is exp(-w). S fades the kernel smoothly to exactly zero between 1.4 and 1.7 radii
// (times sqrt(5 / width)) from the segment, so that distant segments can be left out without a trace.
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// `width`: 5 is the paper's, 1 is Bloomenthal's.
[[nodiscard]] Kernel gaussian(double width);

// Squared distances between which it fades, in (r / sqrt(w))^2, the same whatever the width:
// w (1.4 sqrt(5 / width))^2 = 5 ln 2 1.4^2.
inline constexpr double kFadeBegin = 6.792841769487465; // 5 ln 2 1.4^2
inline constexpr double kFadeEnd = 10.016026079703457;  // 5 ln 2 1.7^2

// How far the surface of a long vessel reaches beyond its free end, in radii: where 1/2 [1 - erf(sqrt(w) x)] is the
// isovalue exp(-w). 0.70752 at width 5, nothing at width 1. `width`: 1 or more.
[[nodiscard]] double reach_beyond_end(double width);

} // namespace ramus::field
