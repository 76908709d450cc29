// Kernels compared: what each makes of joints, and of a tree, so that the choice of the Gaussian can be checked
// (S. Oeltze and B. Preim, IEEE Transactions on Medical Imaging 24, 2005, section IV).
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/surface_options.h"
#include "core/validate/joints.h"
#include "core/validate/validation.h"

#include <cstdint>
#include <vector>

namespace ramus::validate {

struct KernelFigures {
    field::KernelKind kind = field::KernelKind::kGaussian;
    double width = 0.0;         // 0: it has none
    double support_radii = 0.0; // how far from a segment it reaches
    JointFigures joints;
    // Of the tree's surface, the plain sum's.
    RadiusError radius_error;                             // away from joints, ends and other vessels
    double to_cones_mean_mm = 0.0, to_cones_max_mm = 0.0; // of its vertices to truncated cones
    std::size_t merged = 0;                               // vessels that pass each other without a joint and are one
    long pieces = 0, loops = 0; // of the surface; of the graph they are graph_pieces, graph_loops
    std::uint64_t evaluations = 0, triangles = 0;
    double mesh_s = 0.0;
};

struct ComparedKernels {
    std::vector<KernelFigures> kernels;
    long graph_pieces = 0, graph_loops = 0;
};

// All kernels, those with a width at some widths; the tree as `options` prepares it, all else as they say.
// Fails when a surface cannot be made or when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<ComparedKernels> compare_kernels(const tree::VesselTree& source,
                                                      const mesh::SurfaceOptions& options, Job& job);

} // namespace ramus::validate
