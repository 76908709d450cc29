// MeshSlots: a mesh whose vertices and triangles stand tile by tile, so that some tiles can be exchanged without moving
// what the others have. Where tiles have gone, vertices that
// no triangle uses and triangles without area are left until something else takes their place.
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"
#include "core/mesh/polygonize/octree/tile_schedule.h"
#include "core/mesh/surface_edit.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

class MeshSlots {
public:
    // `slack`: share of room beyond what the first tiles take, for later ones.
    void place_vertices(const Octree& octree, std::span<const std::uint32_t> tiles, SurfaceCells& surface,
                        double slack);
    // `joined` is consumed.
    void place_triangles(std::span<const std::uint32_t> tiles, std::vector<JoinedTile> joined, double slack);
    // Takes away all that the tile has, or its triangles and what came with them alone.
    void remove(std::uint32_t tile);
    void remove_triangles(std::uint32_t tile);

    // What was written since the last call.
    [[nodiscard]] SurfaceEdit take_edit();
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    // Without gaps, in the order of a schedule of all tiles: as polygonize() gives it.
    [[nodiscard]] TriangleMesh compact(std::span<const TileBatch> order) const;

private:
    struct TileSlots {
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

    void grow_vertices(double slack);

    TriangleMesh mesh_;
    std::vector<TileSlots> slots_; // by tile
    Space vertex_space_, triangle_space_;
    SurfaceEdit edit_;
};

} // namespace ramus::mesh::bricks
