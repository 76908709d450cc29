// The table of all kernels, one row each, for the command line, sessions and reports.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace ramus::field {

struct Kernel;

enum class KernelKind : std::uint8_t { kGaussian, kInverseCubic, kInverseSquare, kCauchy, kPolynomial };

struct KernelRow {
    KernelKind kind;
    std::string_view key;   // in files and on the command line
    std::string_view label; // for a list or a heading
    double most_width;      // widths from 0.1 to this are allowed; 0: the kernel has no width
    Kernel (*make)(double width);
};

[[nodiscard]] std::span<const KernelRow> kernel_rows(); // in the order of KernelKind
[[nodiscard]] const KernelRow& row_of(KernelKind kind);

// Fails if the kernel does not allow the width.
[[nodiscard]] Result<void> check_width(KernelKind kind, double width);
// Clamps the width to the allowed range; ignores it for kernels without a width.
[[nodiscard]] Kernel make_kernel(KernelKind kind, double width);

} // namespace ramus::field
