// Kernels that fall with a power of the distance s from a point of the skeleton, integrated along segments in closed
// form: inverse squared 1 / s^2, inverse cubic 1 / s^3, and Cauchy's 1 / (1 + c^2 s^2)^2. The literature compares them
// with the Gaussian (A. Sherstyuk, "Kernel functions in convolution surfaces: a comparative analysis", The Visual
// Computer 15, 1999; Oeltze & Preim 2005, section IV).
//
// In local radii all three are (u + e)^-k with u = s^2 and k = 1, 3/2, 2. Cauchy's e is 1 / c^2. The other two are
// infinite on the skeleton, so e = 0.001 is added, which is a distance of 1/32 of the radius. The original kernels have
// infinite support. Here the kernel is
//     g(u) = n [(u + e)^-k - a + b (u - R^2)],   a = (R^2 + e)^-k,   b = k (R^2 + e)^-(k + 1)
// which is the original minus its tangent at u = R^2. It falls smoothly to exactly 0 at the distance R, and is 0
// beyond. Its integral along an infinite line also has a closed form. The isovalue is this integral at a distance of 1
// radius, so the surface of a long vessel is at its radius. n makes the integral 1 on the axis.
//
// The largest error of the cut, anywhere outside a long vessel, relative to the isovalue: 22 % for the inverse squared
// kernel (R = 6), 7.4 % for the inverse cubic one (R = 5), 3.8 % for Cauchy's (R = 4 sqrt(1 + e)). The original kernels
// blend farther: two equal parallel vessels merge at a closeness of 2.00 instead of 1.58, 1.41 instead of 1.35,
// and 1.29 instead of 1.26 (Cauchy's at width 5).
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// These two have no width: the isovalue follows from the power.
[[nodiscard]] Kernel inverse_square();
[[nodiscard]] Kernel inverse_cubic();
// `width`: on the surface of a long vessel the field is 2^-width of its value on the axis, as for the Gaussian; at
// width 1 the surface passes through free ends, as for the Gaussian. From 0.1 to kMostCauchyWidth: beyond, the kernel
// is 1 / s^4 and does not change with the width.
inline constexpr double kMostCauchyWidth = 10.0;
[[nodiscard]] Kernel cauchy(double width);

// The constants of the formula above, in the order of Kernel::numbers.
struct CutPowerNumbers {
    double power = 0.0, reach2 = 0.0, soft = 0.0, factor = 0.0; // k, R^2, e, n
    double cut = 0.0, cut_slope = 0.0;                          // a, b
    double whole = 0.0, rest = 0.0; // the field of a long vessel is about whole / (d^2 + e)^(k - 1/2) - rest
    explicit CutPowerNumbers(const Kernel& kernel);
    // With n = 1, and without `whole` and `rest`.
    CutPowerNumbers(double of_power, double softened_by, double reach);
    // The field of an infinite straight vessel at a squared distance from its axis, in radii.
    [[nodiscard]] double long_vessel(double radii2) const;
};

} // namespace ramus::field
