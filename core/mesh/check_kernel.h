// Whether a surface can be made with the kernel that its options ask for.
#pragma once

#include "core/base/error.h"
#include "core/mesh/surface_options.h"

namespace ramus::mesh {

// Fails where the kernel does not take the width, and where it blends so far that vessels cannot be kept apart: two
// parallel ones merge at a closeness of more than kMostKeptApart. So far the walls between vessels are tried and hold
// for every kernel (tests/core/mesh/kernels_test.cpp); beyond, thin vessels lose pieces beside thick ones. The Gaussian
// is taken at every width.
inline constexpr double kMostKeptApart = 1.5;
[[nodiscard]] Result<void> check_kernel(const SurfaceOptions& options);

} // namespace ramus::mesh
