#include "core/field/kernel.h"

#include <algorithm>

namespace ramus::field {

double radii_at(const Kernel& kernel, double value) {
    double low = 0.0, high = kernel.support_radii;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (kernel.long_vessel->value(kernel, middle * middle) > value ? low : high) = middle;
    }
    return low;
}

void find_reaches(Kernel& kernel) {
    constexpr double kNear = 1.45, kClaim = 1.25; // lower limits: the values of the Gaussian of width 5
    const double two = radii_at(kernel, kernel.isovalue / 2.0), four = radii_at(kernel, kernel.isovalue / 4.0);
    kernel.limits = {two, four, std::max(kNear, 0.5 * (1.0 + kernel.support_radii))};
    kernel.claim_radii = std::max(kClaim, four);
}

} // namespace ramus::field
