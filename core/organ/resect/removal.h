// Removal: the volume that resections remove of an organ, and the surface that they leave, within the organ.
//
// Method: blocks of voxels are halved until the surface is farther away than half their diagonal, or they are small.
// In the small ones the function is sampled at the corners of the voxels' boxes. A voxel that the surface crosses
// counts by the part of its box behind the plane that fits its corners best. Where no plane does (thin gaps, creases,
// two resections in one voxel), it counts by samples inside of its box. The surface is made by marching cubes in these
// boxes (resection_surface.h).
//
// Guarantees: the volume of half spaces is exact for the voxels' boxes; that of smooth surfaces is exact to second
// order in the voxel's size over their radius. The result does not depend on the number of threads. Not guaranteed:
// parts of a surface that are thinner than a voxel.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/organ/organ.h"
#include "core/organ/resect/resection.h"
#include "core/organ/resect/resection_surface.h"

#include <cstddef>
#include <span>
#include <vector>

namespace ramus::organ {

struct Removal {
    std::vector<float> kept; // by voxel of the organ: the share of its box that stays, 0 to 1
    double removed_voxels = 0.0;
    double area_mm2 = 0.0;
    ResectionSurface surface;
};

// `resections`: at most kMostResections. Fails when cancelled (what == "cancelled").
[[nodiscard]] Result<Removal> remove_from(const Organ& organ, std::span<const Resection> resections,
                                          const JobRange& job);

} // namespace ramus::organ
