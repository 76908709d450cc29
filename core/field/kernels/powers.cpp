#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/kernels/powers.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernels/cut_power-inl.h"
#include "core/field/kernels/powers.h"
#include "core/field/sum/plain_sum-inl.h"
#include "core/mesh/tree_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

const PlainSum* inverse_square_sum() { return plain_sum<CompactLine<CutPower<2>>>(); }
const PlainSum* inverse_cubic_sum() { return plain_sum<CompactLine<CutPower<3>>>(); }
const PlainSum* cauchy_sum() { return plain_sum<CompactLine<CutPower<4>>>(); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(inverse_square_sum);
HWY_EXPORT(inverse_cubic_sum);
HWY_EXPORT(cauchy_sum);

namespace {

// The integral of (u + e)^-k along an infinite line is this factor times (d^2 + e)^-(k - 1/2).
double line_factor(double power) {
    return power == 1.0 ? std::numbers::pi : power == 1.5 ? 2.0 : 0.5 * std::numbers::pi;
}

constexpr LongVessel kLongPower{
    [](const Kernel& kernel, double radii2) { return CutPowerNumbers(kernel).long_vessel(radii2); },
    [](const Kernel& kernel, double value) {
        const CutPowerNumbers n(kernel);
        const double degree = 2.0 * n.power - 1.0;
        const double share = std::max(value + n.rest, 1e-12) / n.whole;
        const double p2 = std::pow(share, -2.0 / degree);
        const double at = std::sqrt(std::max(p2 - n.soft, 1e-6));
        return LongVessel::Place{at, degree * n.whole * share * at / p2};
    }};

// `numbers`: with n = 1.
Kernel kernel_of(double width, CutPowerNumbers numbers, const PlainSum* sum) {
    numbers.factor = 1.0 / numbers.long_vessel(0.0);
    Kernel kernel;
    kernel.width = width;
    kernel.isovalue = numbers.long_vessel(1.0);
    kernel.support_radii = kernel.ends_radii = std::sqrt(numbers.reach2);
    kernel.sum = sum;
    kernel.long_vessel = &kLongPower;
    const double whole = numbers.factor * line_factor(numbers.power);
    const double rest = whole * std::pow(1.0 + numbers.soft, 0.5 - numbers.power) - kernel.isovalue;
    kernel.numbers = {numbers.power, numbers.reach2,    numbers.soft, numbers.factor,
                      numbers.cut,   numbers.cut_slope, whole,        rest};
    find_reaches(kernel);
    return kernel;
}

constexpr double kSoft = 1e-3;

// Tuned: powers.h has the errors. The work for a surface grows with the square of the reach.
constexpr double kSquareReach = 6.0, kCubicReach = 5.0, kCauchyReach = 4.0;

CutPowerNumbers cauchy_numbers(double soft) { return {2.0, soft, kCauchyReach * std::sqrt(1.0 + soft)}; }

} // namespace

CutPowerNumbers::CutPowerNumbers(const Kernel& kernel)
    : power(kernel.numbers[0]), reach2(kernel.numbers[1]), soft(kernel.numbers[2]), factor(kernel.numbers[3]),
      cut(kernel.numbers[4]), cut_slope(kernel.numbers[5]), whole(kernel.numbers[6]), rest(kernel.numbers[7]) {}

CutPowerNumbers::CutPowerNumbers(double of_power, double softened_by, double reach)
    : power(of_power), reach2(reach * reach), soft(softened_by), factor(1.0), cut(std::pow(reach2 + soft, -power)),
      cut_slope(power * std::pow(reach2 + soft, -power - 1.0)) {}

double CutPowerNumbers::long_vessel(double radii2) const {
    if (radii2 >= reach2) return 0.0;
    const double room = reach2 - radii2, y = std::sqrt(room), p2 = radii2 + soft, p = std::sqrt(p2), r2 = p2 + room;
    const double angle = std::atan(y / p) / p;
    const double of_power = power == 1.0   ? angle
                            : power == 1.5 ? y / (p2 * std::sqrt(r2))
                                           : 0.5 * (y / r2 + angle) / p2;
    return 2.0 * factor * (of_power - (cut + cut_slope * room) * y + cut_slope * room * y / 3.0);
}

Kernel inverse_square() {
    return kernel_of(0.0, {1.0, kSoft, kSquareReach}, HWY_DYNAMIC_DISPATCH(inverse_square_sum)());
}

Kernel inverse_cubic() { return kernel_of(0.0, {1.5, kSoft, kCubicReach}, HWY_DYNAMIC_DISPATCH(inverse_cubic_sum)()); }

Kernel cauchy(double width) {
    // Bisection: the kernel becomes broader with e.
    double low = 1e-6, high = 1e3;
    for (int i = 0; i < 100; ++i) {
        const double middle = std::sqrt(low * high);
        const CutPowerNumbers numbers = cauchy_numbers(middle);
        (numbers.long_vessel(1.0) / numbers.long_vessel(0.0) < std::exp2(-width) ? low : high) = middle;
    }
    return kernel_of(width, cauchy_numbers(std::sqrt(low * high)), HWY_DYNAMIC_DISPATCH(cauchy_sum)());
}

} // namespace ramus::field
#endif
