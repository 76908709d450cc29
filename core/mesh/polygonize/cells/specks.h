// Specks: parts of the surface of a few cells that are closed by themselves. Beside a wall the region of a vessel may
// end in a ridge thinner than a cell; where its edge runs past a grid point, or a wall past a single edge, this would
// become a piece of surface of its own, or a hole in the inside. They are left out.
//
// Only where vessels are kept apart in every brick that a speck is in; and no part of a vessel that is itself as thin
// as a few cells.
#pragma once

#include "core/mesh/polygonize/cells/loop_walk.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

// Holds scratch memory only: one per thread.
class Specks {
public:
    // The field must outlive it.
    explicit Specks(const field::Field& field) : beyond_(field.in_brick()), isovalue_(field.isovalue()), walk_(field) {}

    // Takes the specks of a subtree away, which has just been filled: `vertices` ends with its own. `parted`: bricks of
    // it in which vessels are kept apart, descending.
    void leave_out(const Octree& octree, std::uint32_t subtree, const ChunkedArray<Neighbourhood>& neighbours,
                   std::span<const std::uint32_t> parted, ChunkedArray<BrickCells>& cells, SubtreeCells& made,
                   SurfaceVertices& vertices);

private:
    void list_candidates(const FilledSubtree& in, std::uint32_t brick);
    void add_around_hanging_corners(const BrickCells& cells, const SubtreeCells& made, std::uint32_t brick);
    [[nodiscard]] bool goes_on(const FilledSubtree& in, std::uint32_t brick, GridBits points, bool inside);
    [[nodiscard]] bool goes_on_in(const Octree& octree, const Brick& brick, const std::array<glm::ivec3, 4>& line,
                                  bool inside);
    void find(const FilledSubtree& in);
    void mark_edges(const Octree& octree, std::uint32_t subtree, ChunkedArray<BrickCells>& cells,
                    SubtreeCells& made) const;

    std::unique_ptr<field::BrickField> beyond_; // in bricks beyond the subtree
    float isovalue_;
    bool looked_beyond_ = false;
    LoopWalk walk_;
    std::vector<LoopPlace> candidates_; // of a brick: one loop or more of all specks that it may have
    std::vector<LoopPlace> loops_;      // of specks, in the subtree's bricks or beyond
    std::vector<LoopEdge> edges_;       // of them
};

} // namespace ramus::mesh::bricks
