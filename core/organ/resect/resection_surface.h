// ResectionSurface: the surface that resections leave within an organ, as triangles. Marching cubes in the boxes of the
// organ's voxels (volume/cell_table.h), with vertices on the exact surface; what another resection removes is clipped
// off.
//
// Guarantees: vertices are on the surface to 1e-9 mm, and within the boxes of the organ's voxels. Neighbouring voxels
// share vertices, except next to the surface of another resection.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/organ/organ.h"
#include "core/organ/resect/resection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::organ {

struct ResectionSurface {
    std::vector<glm::dvec3> places;    // mm
    std::vector<glm::uvec3> triangles; // counter-clockwise seen from what stays
    // By triangle: the voxel that contains it, and the resection.
    std::vector<glm::ivec3> voxels;
    std::vector<std::uint8_t> resections;
};

[[nodiscard]] double area_mm2(const ResectionSurface& surface);
// The surface as a mesh for drawing and for files, with normals.
[[nodiscard]] mesh::TriangleMesh mesh_of(const ResectionSurface& surface);

// The values of a resection at the corners of a box; bit a of a corner's number is its side along axis a.
using CornerValues = std::array<double, 8>;
[[nodiscard]] unsigned removed_corners(const CornerValues& values); // as bits

// The part of a resection's surface in a box that the other resections do not remove. `least`: the lowest corner of the
// box, in voxel indices; `size`: its sides, in voxels.
[[nodiscard]] std::vector<std::array<glm::dvec3, 3>> surface_in_box(const Organ& organ,
                                                                    std::span<const Resection> resections,
                                                                    std::size_t resection, const glm::dvec3& least,
                                                                    double size);

// The triangles of some voxels, before vertices are numbered.
class SurfacePieces {
public:
    // Adds those of a voxel. `removed`: removed_corners() of its box.
    void add_cell(const Organ& organ, const glm::ivec3& voxel, unsigned removed, std::size_t resection);
    // Adds those of a voxel through which several surfaces may pass.
    void add_clipped(const Organ& organ, std::span<const Resection> resections, const glm::ivec3& voxel,
                     std::size_t resection);

private:
    friend ResectionSurface surface_of(const Organ& organ, std::span<const Resection> resections,
                                       std::span<const SurfacePieces> pieces);
    // A vertex on an edge of the voxels' boxes: 4 times the number of the edge's first corner, plus its axis.
    struct Cell {
        glm::ivec3 voxel{0};
        std::uint8_t resection = 0;
        std::array<std::uint64_t, 3> edges{};
    };
    struct Clipped {
        glm::ivec3 voxel{0};
        std::uint8_t resection = 0;
        std::array<glm::dvec3, 3> corners{};
    };
    std::vector<Cell> cells_;
    std::vector<Clipped> clipped_;
};

[[nodiscard]] ResectionSurface surface_of(const Organ& organ, std::span<const Resection> resections,
                                          std::span<const SurfacePieces> pieces);

} // namespace ramus::organ
