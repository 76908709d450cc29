// Checks that a surface can be made with the kernel of its options.
#pragma once

#include "core/base/error.h"
#include "core/mesh/surface_options.h"

namespace ramus::mesh {

// Fails if the kernel does not allow the width. Also fails, with Blend::kTree, if the kernel blends so far that vessels
// cannot be kept apart: two parallel vessels merge at a closeness above kMostKeptApart. Up to this limit tests cover
// the walls of every kernel (tests/core/mesh/kernels_test.cpp). Beyond it, thin vessels lose pieces next to thick ones.
// The Gaussian is accepted at every width.
inline constexpr double kMostKeptApart = 1.5;
[[nodiscard]] Result<void> check_kernel(const SurfaceOptions& options);

} // namespace ramus::mesh
