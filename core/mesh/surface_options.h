// How a surface is made of a vessel tree: the options that every command and the window share.
#pragma once

#include "core/field/kernels/kernel_kind.h"
#include "core/field/rims.h"
#include "core/mesh/blend.h"
#include "core/mesh/method.h"
#include "core/mesh/radii.h"
#include "core/tree/centerline.h"

#include <cstdint>

namespace ramus::mesh {

struct SurfaceOptions {
    Method method = Method::kConvolutionSurface; // of a tree
    int smooth_passes = 1;                       // of voxels' stair-steps (core/tree/smooth.h)
    double prune_ratio = 0.0; // leaf branches shorter than ratio x parent go (core/tree/prepare.h); 0 keeps all
    double width = 5.0;       // kernel width; 5 is the paper's, 1 is Bloomenthal's
    field::KernelKind kernel = field::KernelKind::kGaussian;
    Blend blend = Blend::kTree; // where vessels blend
    tree::Centerline centerline = tree::Centerline::kSmooth;
    Radii radii = Radii::kPlain;            // which the surface has
    field::Rims rims = field::Rims::kApart; // how it ends at walls; overlapping for pictures
    int detail = 16;                        // triangles around a vessel
    double cell_mm = 0.0;                   // one cell size everywhere instead of detail; 0 = use detail
    int threads = 0;                        // 0 = all cores
    std::uint64_t memory_bytes = 0;         // most that the process may take; 0 = half of the machine's
    bool operator==(const SurfaceOptions&) const = default;
};

} // namespace ramus::mesh
