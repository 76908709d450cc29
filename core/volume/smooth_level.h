// A level set for the boundary of a mask without the steps of its voxels: values at the voxels next to the boundary,
// positive inside of the mask and negative outside, that bend as little as they can.
//
// Source: V. Lempitsky, Surface Extraction from Binary Volumes with Higher-Order Smoothness, CVPR 2010. The energy is
// the sum of squared second differences along each axis. Each value has the sign of its voxel and is held to the
// distances, in mm, that its voxel can have to a surface between the voxels. Thick slices leave wide terraces in a
// mask, over which values that bend little are a ramp. Second differences across what is thinner than some four voxels
// do not count: thin vessels and narrow gaps keep their width. Accelerated projected gradient (A. Beck and M. Teboulle,
// A Fast Iterative Shrinkage-Thresholding Algorithm, 2009), which starts from the values for every second voxel, in two
// steps.
//
// Guarantees: the signs, whatever the voxels are, and the same bits for any number of threads. It does not guarantee
// that the energy is the least: terraces far wider than 100 voxels leave a trace.
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

    // In mm, near enough; of a voxel that has another one of the other side next to it along an axis.
    [[nodiscard]] double value(const glm::ivec3& voxel) const { return values_[band_.number_of(voxel)]; }

private:
    MaskBand band_;
    LargeArray<float> values_; // by number in the band
};

// `spacing_mm`: from voxel to voxel along each axis. `memory_bytes`: most that the process may take
// (core/base/memory.h). Fails when that is not enough, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<SmoothLevel> smooth_level(const BitMask& mask, const glm::dvec3& spacing_mm, double memory_bytes,
                                               const JobRange& job);

} // namespace ramus::volume
