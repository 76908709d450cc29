// mask_loops(): where a plane cuts a mask, as loops of the same kind as section() of a surface, around a point.
//
// The plane is sampled at a third of the smallest voxel spacing. The mask is 1 at the centres of voxels inside and 0 at
// others, trilinear between them, and its border is at 0.5: the surface midway between voxels, as everywhere else.
//
// Guarantees: outer loops are counter-clockwise about the normal, holes clockwise. The sampled square begins with
// `half_mm` to each side of the point and grows until it contains the whole region of the plane that is connected with
// the point, so that the region's loops are closed.
// Not guaranteed: structures thinner than a voxel. Small discs in voxels have the area of their voxels, not of the
// disc.
#pragma once

#include "core/slice/section.h"
#include "core/volume/bit_mask.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::slice {

// `mask`: true for voxels inside; `to_patient`: its voxel indices to mm. `at`: a point of the plane. Empty if the point
// is outside of the mask.
[[nodiscard]] std::vector<Loop> mask_loops(const volume::BitMask& mask, const glm::dmat4& to_patient,
                                           const Plane& plane, const glm::dvec3& at, double half_mm);

} // namespace ramus::slice
