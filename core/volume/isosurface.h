// The surface of a segmentation mask or of a scalar field, by marching cubes (W. E. Lorensen and H. E. Cline, SIGGRAPH
// 1987) with a table of our own (core/volume/cell_table.h). The comparison method "Iso": as rough as the voxels are.
//
// Guarantees, whatever the voxels are: the mesh is closed, also where the inside touches the border of the volume;
// every edge has two triangles, the triangles at every vertex form one ring, none is degenerate; triangles are
// counter-clockwise seen from outside, also where the volume's axes mirror. Voxels of the inside that share but a
// corner are joined, those of the outside only where they share a face: so pieces, tunnels and cavities are those that
// digital topology counts in (26, 6)-connectivity, and thin vessels hold together. Threads change nothing.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/volume/bit_mask.h"
#include "core/volume/volume.h"

#include <cstdint>

namespace ramus::volume {

// What becomes of the steps between the voxels of labels, and of a mask.
enum class VoxelSteps : std::uint8_t {
    kKept,     // every vertex midway between two voxel centres
    kSmoothed, // where a level set that bends as little as it can (core/volume/smooth_level.h) is 0 between them
};

struct IsosurfaceOptions {
    double memory_bytes = 0.0; // most that the process shall take; 0 = half of the machine's
    int threads = 0;           // 0 = all cores
    VoxelSteps steps = VoxelSteps::kKept;
};

// Positions in mm, RAS, and outward unit normals, the mean of the triangles around weighted by their areas. No radii
// and no branches: a mask has none. Vertices lie between voxel centres: of an isovalue where linear interpolation has
// it (but at least 1/256 of the way from either, so that no triangle vanishes), of labels midway, at the border of the
// volume half a voxel outside. With smoothed steps each vertex stays on its line between two voxel centres, less than
// half a voxel from the boundary of the voxels, and the triangles are the same. Fails like inside() (bit_mask.h), when
// the mesh takes more memory than allowed or more indices than there are, when single precision cannot tell its
// vertices apart, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<mesh::TriangleMesh> isosurface(const Volume& volume, const Selection& selection,
                                                    const IsosurfaceOptions& options, Job& job);

// Likewise, and the voxels go as soon as they are not needed any more: before the mesh comes, when it is of labels.
[[nodiscard]] Result<mesh::TriangleMesh> isosurface(Volume&& volume, const Selection& selection,
                                                    const IsosurfaceOptions& options, Job& job);

// Likewise of a mask alone, as of labels; of an empty one no triangles.
[[nodiscard]] Result<mesh::TriangleMesh> mask_surface(const BitMask& mask, const glm::dmat4& to_patient,
                                                      const IsosurfaceOptions& options, Job& job);

// Whether single precision can tell the vertices of mask_surface() apart: known before there is a mask.
[[nodiscard]] Result<void> check_mask_precision(const glm::ivec3& size, const glm::dmat4& to_patient);

} // namespace ramus::volume
