// `ramus validate --kernels`: compares the surfaces that different kernels give for joints and for a tree.
#pragma once

#include "core/base/error.h"
#include "core/mesh/surface_options.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

// Compares the kernels and prints a table or, with `json`, an object on standard output. `name`: the file of the tree.
// Fails if the surface of a kernel cannot be computed, or if cancelled.
[[nodiscard]] Result<void> print_kernels(const std::string& name, const tree::VesselTree& tree,
                                         const mesh::SurfaceOptions& options, bool json);

} // namespace ramus::app
