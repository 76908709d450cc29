#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/kernels/gaussian.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernels/gaussian-inl.h"
#include "core/field/kernels/gaussian.h"
#include "core/field/sum/plain_sum-inl.h"

#include <algorithm>
#include <cmath>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

const PlainSum* gaussian_sum() { return plain_sum<Gaussian>(); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(gaussian_sum);

namespace {

// phi = sqrt(-ln F) is linear in the distance from a straight vessel's axis.
constexpr LongVessel kLongGaussian{
    [](const Kernel& kernel, double radii2) { return std::pow(kernel.isovalue, radii2); },
    [](const Kernel& /*kernel*/, double value) {
        const double f = std::clamp(value, 1e-12, 0.999);
        const double phi = std::sqrt(-std::log(f));
        return LongVessel::Place{phi, 2.0 * f * phi};
    }};

} // namespace

Kernel gaussian(double width) {
    const double w = width * std::numbers::ln2;
    constexpr double kErrorFunctionEnd = 3.5; // beyond, erf is constant in single precision
    Kernel kernel;
    kernel.width = width;
    kernel.isovalue = std::exp(-w);
    kernel.support_radii = 1.7 * std::sqrt(5.0 / width);
    kernel.ends_radii = kErrorFunctionEnd / std::sqrt(w);
    kernel.sum = HWY_DYNAMIC_DISPATCH(gaussian_sum)();
    kernel.long_vessel = &kLongGaussian;
    kernel.limits = tree::limits_of_gaussian(width);
    // 1.25 is tuned on trees at width 5, where the vessels of a bundle are rarely equal. Below width 3.6 four equal
    // vessels merge at larger distances.
    kernel.claim_radii = std::max(1.25, kernel.limits.bundled);
    return kernel;
}

double reach_beyond_end(double width) {
    const double w = width * std::log(2.0), sought = 1.0 - 2.0 * std::exp(-w);
    double low = 0.0, high = 6.0; // of erf's argument
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erf(middle) < sought ? low : high) = middle;
    }
    return low / std::sqrt(w);
}

} // namespace ramus::field
#endif
