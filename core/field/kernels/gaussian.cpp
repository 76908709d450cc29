#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/kernels/gaussian.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernels/gaussian-inl.h"
#include "core/field/kernels/gaussian.h"
#include "core/field/sum/plain_sum-inl.h"

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

Kernel gaussian(double width) {
    const double w = width * std::numbers::ln2;
    constexpr double kErrorFunctionEnd = 3.5; // beyond, erf is constant in single precision
    return {width, std::exp(-w), 1.7 * std::sqrt(5.0 / width), kErrorFunctionEnd / std::sqrt(w),
            HWY_DYNAMIC_DISPATCH(gaussian_sum)()};
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
