// Kernels that fall with a power of the distance, beside the Gaussian those that the literature on convolution surfaces
// compares (A. Sherstyuk, "Kernel functions in convolution surfaces: a comparative analysis", The Visual Computer 15,
// 1999; Oeltze & Preim 2005, section IV): inverse squared 1 / s^2, inverse cubic 1 / s^3, and Cauchy's
// 1 / (1 + c^2 s^2)^2, integrated along segments in closed form; s is the distance from a point of the skeleton.
//
// In local radii all three are (u + e)^-k with u = s^2: k = 1, 3/2, 2. Cauchy's e is 1 / c^2; the other two are
// infinite on the skeleton, so that e = 0.001 is added: a distance of 1/32 of the radius. They reach infinitely far;
// here
//     g(u) = n [(u + e)^-k - a + b (u - R^2)],   a = (R^2 + e)^-k,   b = k (R^2 + e)^-(k + 1)
// which is the kernel less its tangent at u = R^2, falls smoothly to exactly 0 at the distance R, and is 0 beyond. Its
// integral along an endless line is closed too: that at a distance of 1 radius is the isovalue, so that the surface of
// a long vessel is at its radius. n makes it 1 on the axis.
//
// What the cut takes away, at most, anywhere outside a long vessel, of the isovalue: 22 % of the inverse squared kernel
// (R = 6), 7.4 % of the inverse cubic one (R = 5), 3.8 % of Cauchy's (R = 4 sqrt(1 + e)). Uncut they blend farther: two
// equal parallel vessels merge at a closeness of 2.00 instead of 1.58, 1.41 instead of 1.35, 1.29 instead of 1.26
// (Cauchy's at width 5).
#pragma once

#include "core/field/kernel.h"

namespace ramus::field {

// They have no width: the isovalue follows from the power.
[[nodiscard]] Kernel inverse_square();
[[nodiscard]] Kernel inverse_cubic();
// `width`: on a long vessel's surface the kernel is 2^-width of what it is on the axis, as the Gaussian is; at width 1
// the surface passes through free ends, as there. From 0.1 to kMostCauchyWidth: from there on it is 1 / s^4, and does
// not change any more.
inline constexpr double kMostCauchyWidth = 10.0;
[[nodiscard]] Kernel cauchy(double width);

// The numbers of such a kernel, as above; in its order in Kernel::numbers.
struct CutPowerNumbers {
    double power = 0.0, reach2 = 0.0, soft = 0.0, factor = 0.0; // k, R^2, e, n
    double cut = 0.0, cut_slope = 0.0;                          // a, b
    double whole = 0.0, rest = 0.0; // of a long vessel the field is about whole / (d^2 + e)^(k - 1/2) - rest
    explicit CutPowerNumbers(const Kernel& kernel);
    // Of n = 1, with no isovalue yet.
    CutPowerNumbers(double of_power, double softened_by, double reach);
    // Of an endless straight vessel, at a squared distance from its axis in radii.
    [[nodiscard]] double long_vessel(double radii2) const;
};

} // namespace ramus::field
