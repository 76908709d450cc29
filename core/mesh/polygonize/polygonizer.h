// Polygonizer: a convolution surface that can follow its tree. It keeps what polygonizing found (octree, cells, mesh),
// and when branches come, go or move it works only where they reach. The surface is then the same, bit for bit, as one
// made from nothing.
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
    // From nothing. Nothing is left when it fails.
    [[nodiscard]] Result<void> make(field::Field field, const PolygonizeOptions& options, Job& job);
    // To another state of the tree, in the same frame; from nothing where that does not help: the first time, and after
    // other options, another frame or another kernel. Nothing is left when it fails.
    [[nodiscard]] Result<void> update(field::Field field, const PolygonizeOptions& options, Job& job);

    [[nodiscard]] const PolygonizeStatistics& statistics() const { return statistics_; } // of the last call
    [[nodiscard]] SurfaceEdit take_edit();
    // With gaps (MeshSlots), and without.
    [[nodiscard]] const TriangleMesh& slots() const { return slots_.mesh(); }
    [[nodiscard]] std::vector<Bounds<glm::vec3>> walled() const; // as polygonize() has them
    [[nodiscard]] TriangleMesh compact() const { return slots_.compact(bricks::schedule_subtrees(octree_)); }

private:
    // What belongs to one state of the tree.
    struct State {
        field::Field field;
        bricks::Sizing sizing;
        PolygonizeOptions options;
    };
    // What changed since the present state, where following that pays.
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
