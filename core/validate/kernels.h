// Compares all kernels at joints and on a tree, to check the choice of the Gaussian (S. Oeltze and B. Preim, IEEE
// Transactions on Medical Imaging 24, 2005, section IV).
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
    double width = 0.0;         // 0: the kernel has no width
    double support_radii = 0.0; // how far from a segment the kernel reaches
    JointFigures joints;
    // The surface of the tree, as a plain sum:
    RadiusError radius_error;                             // away from joints, ends and other vessels
    double to_cones_mean_mm = 0.0, to_cones_max_mm = 0.0; // distance of its vertices from truncated cones
    std::size_t merged = 0;                               // pairs of vessels without a joint that are merged
    long pieces = 0, loops = 0;                           // of the surface; compare with graph_pieces and graph_loops
    std::uint64_t evaluations = 0, triangles = 0;
    double mesh_s = 0.0;
};

struct ComparedKernels {
    std::vector<KernelFigures> kernels;
    long graph_pieces = 0, graph_loops = 0;
};

// Compares all kernels, those with a width at several widths, on the tree as prepared by `options`. Fails if a surface
// cannot be made, or if `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<ComparedKernels> compare_kernels(const tree::VesselTree& source,
                                                      const mesh::SurfaceOptions& options, Job& job);

} // namespace ramus::validate
