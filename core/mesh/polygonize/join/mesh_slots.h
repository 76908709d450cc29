// MeshSlots: a mesh in which each subtree has ranges of vertices and triangles, so that subtrees can be replaced
// without moving the data of others. Ranges of removed subtrees contain unused vertices and triangles without area,
// until they are overwritten.
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

class MeshSlots {
public:
    // `reserve`: the share of additional capacity, for later subtrees.
    void place_vertices(const Octree& octree, std::span<const std::uint32_t> subtrees, SurfaceCells& surface,
                        double reserve);
    // `joined` is consumed.
    void place_triangles(std::span<const std::uint32_t> subtrees, std::vector<JoinedSubtree> joined, double reserve);
    // Removes the vertices and triangles of a subtree; or only its triangles, and the vertices that were added with
    // them.
    void remove(std::uint32_t subtree);
    void remove_triangles(std::uint32_t subtree);

    // The parts of the mesh that were written since the last call.
    [[nodiscard]] SurfaceEdit take_edit();
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    // The mesh without gaps, in the order of a schedule of all subtrees, as polygonize() returns it.
    [[nodiscard]] TriangleMesh compact(std::span<const SubtreeBatch> order) const;

private:
    struct SubtreeSlots {
        SlotRange vertices, added, triangles; // added: vertices that were added with the triangles
    };
    // The unused ranges of an array, and its end.
    class Space {
    public:
        [[nodiscard]] SlotRange take(std::uint64_t count);
        void give_back(SlotRange range);
        [[nodiscard]] std::uint64_t end() const { return end_; }

    private:
        std::vector<SlotRange> free_;
        std::uint64_t end_ = 0;
    };

    void grow_vertices(double reserve);

    TriangleMesh mesh_;
    std::vector<SubtreeSlots> slots_; // by subtree
    Space vertex_space_, triangle_space_;
    SurfaceEdit edit_;
};

} // namespace ramus::mesh::bricks
