#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/kernels/polynomial.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernels/polynomial-inl.h"
#include "core/field/kernels/polynomial.h"
#include "core/field/sum/plain_sum-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

const PlainSum* polynomial_sum() { return plain_sum<CompactLine<Quartic>>(); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(polynomial_sum);

namespace {

constexpr LongVessel kLongPolynomial{
    [](const Kernel& kernel, double radii2) {
        return std::pow(std::max(1.0 - radii2 / (kernel.support_radii * kernel.support_radii), 0.0), 2.5);
    },
    [](const Kernel& kernel, double value) {
        const double share = std::pow(std::clamp(value, 1e-12, 1.0), 0.4), reach = kernel.support_radii;
        const double at = reach * std::sqrt(std::max(1.0 - share, 1e-6));
        return LongVessel::Place{at, 5.0 * at * std::pow(share, 1.5) / (reach * reach)};
    }};

} // namespace

Kernel polynomial(double width) {
    Kernel kernel;
    kernel.width = width;
    kernel.isovalue = std::exp2(-width);
    kernel.support_radii = kernel.ends_radii = 1.0 / std::sqrt(1.0 - std::exp2(-0.4 * width));
    kernel.sum = HWY_DYNAMIC_DISPATCH(polynomial_sum)();
    kernel.long_vessel = &kLongPolynomial;
    find_reaches(kernel);
    return kernel;
}

} // namespace ramus::field
#endif
