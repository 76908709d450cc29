// SmoothLevel: a level set of the boundary of a mask, smoothed to remove the steps between voxels. It has values at the
// voxels near the boundary, positive inside the mask and negative outside.
//
// Source: V. Lempitsky, Surface Extraction from Binary Volumes with Higher-Order Smoothness, CVPR 2010. The energy is
// the sum of squared second differences along each axis. Each value keeps the sign of its voxel, and is bounded by the
// distances, in mm, that its voxel can have to a surface between the voxels. So the wide terraces that thick slices
// leave become ramps. Second differences across parts that are thinner than about four voxels do not count: thin
// vessels and narrow gaps keep their width. The solver is an accelerated projected gradient (A. Beck and M. Teboulle, A
// Fast Iterative Shrinkage-Thresholding Algorithm, 2009), initialised from two coarser resolutions.
//
// Guaranteed: the signs, for any voxels, and the same bits for any number of threads.
// Not guaranteed: the minimum of the energy. Terraces far wider than 100 voxels stay visible.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/mask_band.h"

#include <glm/vec3.hpp>

namespace ramus::volume {

class SmoothLevel {
public:
    SmoothLevel(MaskBand band, LargeArray<float> values) : band_(std::move(band)), values_(std::move(values)) {}

    // The approximate signed distance to the boundary in mm. A neighbour along an axis must be on the other side.
    [[nodiscard]] double value(const glm::ivec3& voxel) const { return values_[band_.number_of(voxel)]; }

private:
    MaskBand band_;
    LargeArray<float> values_; // by number in the band
};

// `spacing_mm`: of the voxels along each axis. `memory_bytes`: memory limit of the process (core/base/memory.h). Fails
// if that is not enough, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<SmoothLevel> smooth_level(const BitMask& mask, const glm::dvec3& spacing_mm, double memory_bytes,
                                               const JobRange& job);

} // namespace ramus::volume
