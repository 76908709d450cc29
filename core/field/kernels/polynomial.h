// The quartic polynomial kernel (1 - s^2 / R^2)^2 of A. Sherstyuk ("Kernel functions in convolution surfaces: a
// comparative analysis", The Visual Computer 15, 1999; Oeltze & Preim 2005, section IV), integrated along segments in
// closed form. s is the distance from a point of the skeleton. The kernel is exactly 0 beyond R.
//
// Its field of an infinite line is 16/15 R (1 - d^2 / R^2)^(5/2), which is scaled to 1 on the axis. The isovalue is
// 2^-width. The surface of a long vessel is at its radius r if (1 - r^2 / R^2)^(5/2) = 2^-width, so
// R = r / sqrt(1 - 2^(-0.4 width)): 1.1547 r at width 5, 2.0322 r at width 1.
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// `width`: on the surface of a long vessel the field is 2^-width of its value on the axis, as for the Gaussian. From
// 0.1 to kMostPolynomialWidth: with a larger width the kernel ends so close to the surface that meshes of usual detail
// miss it.
inline constexpr double kMostPolynomialWidth = 10.0;
[[nodiscard]] Kernel polynomial(double width);

} // namespace ramus::field
