// The quartic polynomial (1 - s^2 / R^2)^2 of A. Sherstyuk ("Kernel functions in convolution surfaces: a comparative
// analysis", The Visual Computer 15, 1999; Oeltze & Preim 2005, section IV), integrated along segments in closed form;
// s is the distance from a point of the skeleton. It is exactly 0 beyond R by itself.
//
// Of an endless line it makes 16/15 R (1 - d^2 / R^2)^(5/2), which is scaled to 1 on the axis. R says how far it
// blends: where (1 - r^2 / R^2)^(5/2) = 2^-width, the isovalue, the surface of a long vessel is at its radius r, so
// that R = r / sqrt(1 - 2^(-0.4 width)): 1.1547 r at width 5, 2.0322 r at width 1.
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// `width`: on a long vessel's surface the kernel is 2^-width of what it is on the axis, as the Gaussian is. From 0.1 to
// kMostPolynomialWidth: beyond, it ends so close to the surface that meshes of usual detail do not find it.
inline constexpr double kMostPolynomialWidth = 10.0;
[[nodiscard]] Kernel polynomial(double width);

} // namespace ramus::field
