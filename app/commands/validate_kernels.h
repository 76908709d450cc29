// ramus validate --kernels: what each kernel makes of joints and of a tree, as a table and as JSON.
#pragma once

#include "core/base/error.h"
#include "core/mesh/surface_options.h"

#include <string>

namespace ramus::app {

// Compares and prints, on standard output. `name`: of the tree's file.
[[nodiscard]] Result<void> print_kernels(const std::string& name, const tree::VesselTree& tree,
                                         const mesh::SurfaceOptions& options, bool json);

} // namespace ramus::app
