// Computes the surface of a segmentation mask or of a scalar field by marching cubes (W. E. Lorensen and H. E. Cline,
// SIGGRAPH 1987) with our own table (cell_table.h). This is the paper's comparison method "Iso".
//
// Guarantees, for any voxels:
// - The mesh is closed, also where the inside touches the border of the volume. Every edge has two triangles, the
//   triangles at every vertex form one ring, and no triangle is degenerate.
// - Triangles are counter-clockwise seen from outside, also if the volume's axes mirror.
// - Pieces, tunnels and cavities are those of (26, 6)-connectivity: inside voxels that share only a corner are
//   connected, outside voxels only if they share a face. So thin vessels stay connected.
// - The result does not depend on the number of threads.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/volume/bit_mask.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <filesystem>

namespace ramus::volume {

// Whether the surface of labels or a mask shows the steps between voxels.
enum class VoxelSteps : std::uint8_t {
    kKept,     // every vertex midway between two voxel centres
    kSmoothed, // where a level set of least bending (smooth_level.h) is 0 between the two centres
};

struct IsosurfaceOptions {
    double memory_bytes = 0.0; // memory limit of the process; 0: half of the machine's memory
    int threads = 0;           // 0: all cores
    VoxelSteps steps = VoxelSteps::kKept;
    // The file that will be written: a mesh that takes more memory than is left is on its disk
    // (core/base/disk_pages.h). Empty: such a mesh is refused.
    std::filesystem::path target = {};
};

// Returns positions in mm, RAS, and outward unit normals: the area-weighted mean of the triangles around a vertex. The
// mesh has no radii and branches. Each vertex is on the line between two neighbouring voxel centres: for an isovalue
// where linear interpolation reaches it (but at least 1/256 of the way from either centre, so that no triangle
// vanishes), for labels midway, and at the border of the volume half a voxel outside. Smoothed steps move a vertex
// along its line by less than half a voxel, and keep the triangles.
//
// Fails like inside() (bit_mask.h), if the mesh exceeds the memory limit, the disk or 32-bit indices, if single
// precision cannot distinguish its vertices, and when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<mesh::TriangleMesh> isosurface(const Volume& volume, const Selection& selection,
                                                    const IsosurfaceOptions& options, Job& job);

// The same, but frees the voxels as soon as possible: for labels before the mesh is built.
[[nodiscard]] Result<mesh::TriangleMesh> isosurface(Volume&& volume, const Selection& selection,
                                                    const IsosurfaceOptions& options, Job& job);

// The same for a mask, as for labels. An empty mask gives an empty mesh. `to_patient`: voxel indices to mm, RAS.
[[nodiscard]] Result<mesh::TriangleMesh> mask_surface(const BitMask& mask, const glm::dmat4& to_patient,
                                                      const IsosurfaceOptions& options, Job& job);

// Fails if single precision cannot distinguish the vertices of mask_surface(). Can be checked before there is a mask.
[[nodiscard]] Result<void> check_mask_precision(const glm::ivec3& size, const glm::dmat4& to_patient);

} // namespace ramus::volume
