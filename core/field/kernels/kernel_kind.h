// The kernels that a surface can be made with, one row each: the command line, sessions and tables read them here.
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
    std::string_view label; // where it stands alone
    double most_width;      // it takes widths from 0.1 to this; 0: it has none
    Kernel (*make)(double width);
};

[[nodiscard]] std::span<const KernelRow> kernel_rows(); // in the order of KernelKind
[[nodiscard]] const KernelRow& row_of(KernelKind kind);

// Fails where the kernel does not take the width.
[[nodiscard]] Result<void> check_width(KernelKind kind, double width);
// A width that it does not take is the nearest that it does; one that has no width makes nothing of it.
[[nodiscard]] Kernel make_kernel(KernelKind kind, double width);

} // namespace ramus::field
