// How much a solid and a mask have in common, counted in the mask's voxels: volumes and Dice's coefficient.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/volume/bit_mask.h"

#include <cstdint>
#include <glm/mat4x4.hpp>

namespace ramus::validate {

// Voxels whose middle is inside; of the surface also those of the same grid beyond the mask's border.
struct Overlap {
    std::uint64_t mask = 0, surface = 0, both = 0;
    double voxel_mm3 = 0.0;
    // 2 |A and B| / (|A| + |B|): 1 where they are the same, 0 where they have nothing in common.
    [[nodiscard]] double dice() const;
};

// `to_patient`: of voxel indices, whole numbers in the voxels' middles, to mm, RAS. Inside is where the surface winds
// around a place, so that solids may overlap. The surface has a triangle at least. Fails when `job` is cancelled (what
// == "cancelled").
[[nodiscard]] Result<Overlap> overlap_of(const mesh::TriangleMesh& surface, const volume::BitMask& mask,
                                         const glm::dmat4& to_patient, Job& job);

} // namespace ramus::validate
