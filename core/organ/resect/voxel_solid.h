// VoxelSolid: a set of voxels as a solid, the union of their boxes; or the inside of a closed mesh. Its surface is the
// faces of boxes that do not touch another voxel of the set. Distances are from that surface, exact up to the rounding
// of corners to single precision (1e-5 mm). Immutable and safe for concurrent use.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/measure/cuts.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"
#include "core/organ/organ.h"
#include "core/organ/remnant.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ramus::organ {

class VoxelSolid {
public:
    // `voxels`: at least one.
    explicit VoxelSolid(Organ voxels);
    // The inside of a closed mesh; its voxels() are samples of it, 32 along its longest side.
    explicit VoxelSolid(mesh::TriangleMesh closed);

    [[nodiscard]] const Organ& voxels() const { return voxels_; }
    [[nodiscard]] const mesh::TriangleMesh& surface() const { return surface_; } // positions and triangles
    [[nodiscard]] bool contains(const glm::dvec3& point) const;
    // The distance of a point from the solid: 0 inside and on its surface.
    [[nodiscard]] double distance(const glm::dvec3& point) const;
    [[nodiscard]] const measure::MeshDistance& to_surface() const { return to_surface_; }

private:
    mesh::TriangleMesh surface_;
    measure::MeshDistance to_surface_;
    Organ voxels_;
    glm::dmat4 to_voxels_;
    bool of_boxes_ = true;
};

// The surface of a set of voxels: two triangles for each outer face, counter-clockwise from outside. Faces share
// vertices.
[[nodiscard]] mesh::TriangleMesh surface_of_boxes(const Organ& voxels);

// The voxels of an organ whose entry is not 0; empty: all. Null: there are none.
[[nodiscard]] std::shared_ptr<const VoxelSolid> solid_of(const Organ& organ, std::span<const std::uint8_t> chosen);

// The solid of each of `count` parts. `parts`: by voxel of the organ, each part has voxels.
[[nodiscard]] std::vector<std::shared_ptr<const VoxelSolid>> solids_of(const Organ& organ, std::span<const int> parts,
                                                                       std::size_t count);

// By voxel of the organ, 1: after the cuts (`spans`, of lost_spans()) some system does not reach it any more.
[[nodiscard]] std::vector<std::uint8_t> lost_voxels(std::span<const SystemSupply> systems,
                                                    std::span<const measure::LostSpan> spans);

// A lesion of a mask.
struct VoxelLesion {
    std::string name;
    std::shared_ptr<const VoxelSolid> solid;
};

// The parts of a mask that do not touch by faces, the largest first, named "NAME 1", "NAME 2", or NAME if there is one.
[[nodiscard]] std::vector<VoxelLesion> lesions_of(const Organ& mask, const std::string& name);

} // namespace ramus::organ
