#include "core/field/kernels/kernel_kind.h"

#include "core/field/kernels/gaussian.h"
#include "core/field/kernels/polynomial.h"
#include "core/field/kernels/powers.h"

#include <algorithm>
#include <array>
#include <string>

namespace ramus::field {

namespace {

constexpr std::array<KernelRow, 5> kKernels = {{
    {KernelKind::kGaussian, "gaussian", "Gaussian", 100.0, gaussian},
    {KernelKind::kInverseCubic, "inverse-cubic", "Inverse cubic", 0.0, [](double) { return inverse_cubic(); }},
    {KernelKind::kInverseSquare, "inverse-square", "Inverse square", 0.0, [](double) { return inverse_square(); }},
    {KernelKind::kCauchy, "cauchy", "Cauchy", kMostCauchyWidth, cauchy},
    {KernelKind::kPolynomial, "polynomial", "Polynomial", kMostPolynomialWidth, polynomial},
}};

} // namespace

std::span<const KernelRow> kernel_rows() { return kKernels; }

const KernelRow& row_of(KernelKind kind) { return kKernels[static_cast<std::size_t>(kind)]; }

Result<void> check_width(KernelKind kind, double width) {
    const KernelRow& row = row_of(kind);
    if (row.most_width == 0.0 || width <= row.most_width) return {};
    const std::string most = std::to_string(static_cast<int>(row.most_width));
    return fail("the kernel " + std::string(row.key) + " takes a width from 0.1 to " + most, {},
                "give a --width of " + most + " at most, or another --kernel");
}

Kernel make_kernel(KernelKind kind, double width) {
    const KernelRow& row = row_of(kind);
    return row.make(row.most_width > 0.0 ? std::min(width, row.most_width) : width);
}

} // namespace ramus::field
