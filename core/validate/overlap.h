// Overlap of a surface's solid and a mask, counted in voxels of the mask: volumes and Dice's coefficient.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/volume/bit_mask.h"

#include <cstdint>
#include <glm/mat4x4.hpp>

namespace ramus::validate {

// Numbers of voxels whose centre is inside. `surface` includes voxels of the same grid beyond the mask's border.
struct Overlap {
    std::uint64_t mask = 0, surface = 0, both = 0;
    double voxel_mm3 = 0.0;
    // 2 |A and B| / (|A| + |B|): 1 if they are equal, 0 if they are disjoint.
    [[nodiscard]] double dice() const;
};

// `to_patient`: transforms voxel indices (integers at voxel centres) to mm, RAS. Inside is decided by the winding
// number, so solids may overlap. The surface must have at least one triangle. Fails if `job` is cancelled (what ==
// "cancelled").
[[nodiscard]] Result<Overlap> overlap_of(const mesh::TriangleMesh& surface, const volume::BitMask& mask,
                                         const glm::dmat4& to_patient, Job& job);

} // namespace ramus::validate
