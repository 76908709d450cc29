// section(): where a plane cuts a triangle mesh, as loops.
//
// Guarantees: each point of a loop lies on an edge of the mesh, exactly in the plane up to rounding in double
// precision. On a closed, oriented mesh all loops are closed, and the inside of the mesh is on their left, seen from
// the tip of the normal: outer loops are counter-clockwise, holes clockwise. The result does not depend on threads. A
// vertex in the plane counts as above it, so that no case is special. Not guaranteed: on a mesh with holes, open
// polylines. On a mesh whose edges have more than two triangles, the pairing of the polylines that meet there.
//
// The mesh may be in parts: section() cuts a TriangleMesh, whose index MeshBlocks makes repeated sections fast. Other
// containers call cut_triangles() for the parts that the plane crosses, and then joined_loops().
#pragma once

#include "core/base/bounds.h"
#include "core/mesh/triangle_mesh.h"
#include "core/slice/pixel_grid.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::slice {

// A point on the edge between two vertices, the lower number first. A value of the vertices is, at the point,
// (1 - share) * value of the first + share * value of the second.
struct EdgePoint {
    std::uint32_t first = 0, second = 0;
    float share = 0.0F;
    glm::dvec3 at{0.0}; // mm
    [[nodiscard]] std::uint32_t nearer() const { return share < 0.5F ? first : second; }
};

// The piece of a triangle's section; the inside of the mesh is on its left.
struct CutTriangle {
    EdgePoint from, to;
};

struct Loop {
    std::vector<EdgePoint> points; // closed: no point twice
    bool closed = true;
};

// Appends the pieces of the triangles that the plane cuts. `position(vertex)` is a glm::dvec3 in mm.
template <class Position>
void cut_triangles(std::span<const glm::uvec3> triangles, const Plane& plane, const Position& position,
                   std::vector<CutTriangle>& pieces) {
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 corners[3]{position(triangle.x), position(triangle.y), position(triangle.z)};
        const double heights[3]{plane.height(corners[0]), plane.height(corners[1]), plane.height(corners[2])};
        const int above = int(heights[0] >= 0.0) + int(heights[1] >= 0.0) + int(heights[2] >= 0.0);
        if (above == 0 || above == 3) continue;
        CutTriangle piece;
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            if ((heights[k] >= 0.0) == (heights[next] >= 0.0)) continue;
            const bool ordered = triangle[k] < triangle[next]; // both triangles of an edge must get the same bits
            const int low = ordered ? k : next;
            const int high = ordered ? next : k;
            const double share = heights[low] / (heights[low] - heights[high]);
            EdgePoint& point = heights[k] >= 0.0 ? piece.from : piece.to;
            point = {triangle[low], triangle[high], static_cast<float>(share),
                     corners[low] + share * (corners[high] - corners[low])};
        }
        pieces.push_back(piece);
    }
}

// Joins pieces at equal edges. Loops come in the order of their smallest edge.
[[nodiscard]] std::vector<Loop> joined_loops(const std::vector<CutTriangle>& pieces);

// Boxes around runs of triangles that follow each other. Refers to the mesh, which must not change.
class MeshBlocks {
public:
    explicit MeshBlocks(const mesh::TriangleMesh& mesh);
    [[nodiscard]] const mesh::TriangleMesh& mesh() const { return *mesh_; }
    // The triangles of blocks whose box the plane crosses.
    template <class Call> void for_crossed(const Plane& plane, const Call& call) const {
        const std::span<const glm::uvec3> all(mesh_->triangles);
        for (std::size_t b = 0; b < boxes_.size(); ++b)
            if (crosses(plane, boxes_[b])) call(all.subspan(b * kBlock, std::min(kBlock, all.size() - b * kBlock)));
    }

private:
    static constexpr std::size_t kBlock = 256; // tuned: smaller boxes cost more than the triangles that they spare
    static bool crosses(const Plane& plane, const Bounds<glm::vec3>& box);

    const mesh::TriangleMesh* mesh_;
    std::vector<Bounds<glm::vec3>> boxes_;
};

[[nodiscard]] std::vector<Loop> section(const MeshBlocks& blocks, const Plane& plane);
[[nodiscard]] std::vector<Loop> section(const mesh::TriangleMesh& mesh, const Plane& plane);

// Whether a plane crosses a box, or touches it.
[[nodiscard]] bool plane_crosses(const Plane& plane, const Bounds<glm::dvec3>& box);

// The area that loops enclose in their plane, holes subtracted, mm2.
[[nodiscard]] double enclosed_mm2(std::span<const Loop> loops, const glm::dvec3& normal);

} // namespace ramus::slice
