// Polygonizer: a surface that can be updated incrementally. It keeps the octree, the cells and the mesh. When branches
// are added, removed or changed, it recomputes only the parts that they reach. The result has the same bits as a
// surface computed from scratch.
#pragma once

#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/join/mesh_slots.h"
#include "core/mesh/polygonize/octree/update_octree.h"
#include "core/mesh/polygonize/polygonize.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::mesh {

class Polygonizer {
public:
    // Computes the surface from scratch. If it fails, there is no surface.
    [[nodiscard]] Result<void> make(field::Field field, const PolygonizeOptions& options, Job& job);
    // Updates the surface to another state of the tree. Computes it from scratch in the first call, and if the options,
    // the extent or the kernel have changed. If it is cancelled, or computing from scratch fails, there is no surface.
    [[nodiscard]] Result<void> update(field::Field field, const PolygonizeOptions& options, Job& job);

    [[nodiscard]] const PolygonizeStatistics& statistics() const { return statistics_; } // of the last call
    // The parts of slots() that were written since the last call.
    [[nodiscard]] SurfaceEdit take_edit();
    // The mesh with gaps (MeshSlots).
    [[nodiscard]] const TriangleMesh& slots() const { return slots_.mesh(); }
    [[nodiscard]] std::vector<Bounds<glm::vec3>> walled() const; // boxes around walls, as polygonize() returns them
    // The mesh without gaps, as polygonize() returns it.
    [[nodiscard]] TriangleMesh compact() const { return slots_.compact(bricks::schedule_subtrees(octree_)); }

private:
    // The data of one state of the tree.
    struct State {
        field::Field field;
        bricks::Sizing sizing;
        PolygonizeOptions options;
    };
    // The changes from the present state; nothing if computing from scratch is necessary or cheaper.
    [[nodiscard]] std::optional<field::SegmentChanges> changes_to(const field::Field& field,
                                                                  const PolygonizeOptions& options) const;
    [[nodiscard]] Result<void> make(std::unique_ptr<State> state, Job& job);
    [[nodiscard]] bool follow(std::unique_ptr<State> state, const field::SegmentChanges& segments,
                              Job& job); // false: cancelled
    [[nodiscard]] std::vector<std::uint32_t> find_new_neighbours(const bricks::OctreeChanges& changes);
    [[nodiscard]] std::vector<std::uint32_t> find_lookers(const bricks::OctreeChanges& changes);
    void count(std::span<const std::uint32_t> subtrees);
    void clear();

    std::unique_ptr<State> state_; // null: there is no surface
    bricks::Octree octree_;
    bricks::SurfaceCells cells_;
    bricks::MeshSlots slots_;
    std::size_t live_bricks_ = 0;
    bool whole_ = false;
    PolygonizeStatistics statistics_;
};

} // namespace ramus::mesh
