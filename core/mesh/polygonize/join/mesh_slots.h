// MeshSlots: a mesh whose vertices and triangles stand subtree by subtree, so that some subtrees can be exchanged
// without moving what the others have. Where subtrees have gone, vertices that no triangle uses and triangles without
// area are left until something else is written there.
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
    // `reserve`: share of capacity beyond what the first subtrees take, for later ones.
    void place_vertices(const Octree& octree, std::span<const std::uint32_t> subtrees, SurfaceCells& surface,
                        double reserve);
    // `joined` is consumed.
    void place_triangles(std::span<const std::uint32_t> subtrees, std::vector<JoinedSubtree> joined, double reserve);
    // Takes away all that the subtree has, or its triangles and what came with them alone.
    void remove(std::uint32_t subtree);
    void remove_triangles(std::uint32_t subtree);

    // What was written since the last call.
    [[nodiscard]] SurfaceEdit take_edit();
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    // Without gaps, in the order of a schedule of all subtrees: as polygonize() gives it.
    [[nodiscard]] TriangleMesh compact(std::span<const SubtreeBatch> order) const;

private:
    struct SubtreeSlots {
        SlotRange vertices, added, triangles; // added: vertices that came with the triangles
    };
    // Ranges of some array that are not in use, and its end.
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
