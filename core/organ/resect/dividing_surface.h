// DividingSurface: a triangle mesh that divides an organ. Of a closed mesh the two sides are its inside and its
// outside. An open mesh must divide the organ: no path from voxel to voxel through faces may lead around its border,
// from one side to the other. Its sides are those of the voxels' centres; a point is on the side of the nearest voxel
// unless the mesh lies between. Immutable and safe for concurrent use.
//
// Guarantees: distances are to the triangles, exact up to rounding. Where the mesh has several layers, its sides
// alternate. Not guaranteed: the side of a point farther than a voxel from the organ.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/organ.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::organ {

class DividingSurface {
public:
    // `mesh`: welded, as io::read_mesh_file() reads it. Fails if an open mesh does not divide the organ, and when
    // cancelled (what == "cancelled").
    [[nodiscard]] static Result<std::shared_ptr<const DividingSurface>> of(mesh::TriangleMesh mesh, const Organ& organ,
                                                                           const JobRange& job);

    [[nodiscard]] bool is_closed() const { return closed_; }
    // The distance from the mesh; negative inside a closed mesh, and on the smaller side (in voxels) of an open one.
    [[nodiscard]] double value_at(const glm::dvec3& point) const;
    // Whether the centre of a voxel of the organ is on the negative side.
    [[nodiscard]] bool negative(const glm::ivec3& voxel) const;

private:
    DividingSurface(mesh::TriangleMesh mesh, const Organ& organ);
    [[nodiscard]] Result<void> find_sides(const JobRange& job);
    void cross_links_in(const glm::ivec3& from, const glm::ivec3& to);
    void spread_from(const glm::ivec3& first, std::uint8_t side, bool& divides);
    [[nodiscard]] bool odd_crossings(const glm::dvec3& from, const glm::dvec3& to) const;
    [[nodiscard]] glm::dvec3 reference(const glm::ivec3& voxel) const;
    [[nodiscard]] std::size_t cell(const glm::ivec3& voxel) const;

    mesh::TriangleMesh mesh_;
    measure::PackedTriangles triangles_;
    measure::MeshDistance distance_;
    bool closed_;
    // Of an open mesh only:
    volume::BitMask voxels_; // of the organ
    glm::dmat4 to_patient_, to_voxels_;
    // By voxel of the volume: bits 0 to 2, the mesh lies between it and the next voxel along an axis; then its side.
    std::vector<std::uint8_t> links_, sides_;
    std::uint8_t smaller_ = 0;
};

} // namespace ramus::organ
