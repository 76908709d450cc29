// LabelNet: the connectivity of label_surfaces(): vertices in cells of eight voxel centres, and a polygon between two
// neighbouring voxels of different labels. All positions are in voxels.
//
// Four voxels around an edge of the voxels' grid may touch crosswise. Then the two of one label are connected, and the
// polygons around each of the other two are joined. A vertex stands for polygons of its cell that are joined. Two
// joints that would connect the same two vertices get a vertex of their own each (a middle).
#pragma once

#include "core/organ/label_surfaces.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::organ::surfaces {

// An edge between two cells, at which polygons are joined.
struct Arc {
    std::uint32_t from, to; // vertices
    bool junction;          // between three or more labels
    bool outer;             // on the border of the organ
};

// A vertex in the middle of an arc.
struct Middle {
    std::uint32_t vertex, from, to;
};

struct LabelNet {
    std::vector<glm::vec3> corners;                  // by vertex: the corner of voxels that it stands for
    std::vector<glm::vec3> starts;                   // near the corner: vertices of one cell are apart
    std::vector<Arc> arcs;                           // those with middles from end to end
    std::vector<Middle> middles;                     // the last vertices
    std::vector<std::array<std::uint32_t, 4>> quads; // in the order of Sides; polygons without middles
    std::vector<Sides> quad_sides;                   // by quad
    std::vector<glm::uvec3> triangles;               // polygons with middles
    std::vector<Sides> triangle_sides;               // by triangle
};

// None: cancelled, or more vertices than 32-bit indices can count.
[[nodiscard]] std::optional<LabelNet> label_net(const Organ& organ, std::span<const int> labels, const JobRange& job);

} // namespace ramus::organ::surfaces
