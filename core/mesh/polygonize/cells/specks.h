// Specks: parts of the surface of a few cells that are closed by themselves and are no vessel's. Beside a wall the
// region of a vessel may end in a ridge thinner than a cell; where its edge runs past a grid point, or a wall past a
// single edge, this would become a piece of surface of its own, or a hole in the inside. Where vessels come close to
// each other beside a joint, the sum may rise above the isovalue, or fall below it, around a single grid point. They
// are left out: what encloses the outside, what no axis goes through, and, where vessels are kept apart in every brick
// that it is in, what is too small for the vessel that it is part of. Where some brick of it keeps none apart, only
// what is within one subtree, so that each depends on itself alone.
#pragma once

#include "core/base/bounds.h"
#include "core/mesh/polygonize/cells/loop_walk.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

// Holds scratch memory only: one per thread.
class Specks {
public:
    // The field must outlive it.
    explicit Specks(const field::Field& field)
        : skeleton_(field.skeleton()), beyond_(field.in_brick()), isovalue_(field.isovalue()), walk_(field) {}

    // Takes the specks of a subtree away, which has just been filled: `vertices` ends with its own. `parted`: bricks of
    // it in which vessels are kept apart, descending.
    void leave_out(const Octree& octree, std::uint32_t subtree, const ChunkedArray<Neighbourhood>& neighbours,
                   std::span<const std::uint32_t> parted, ChunkedArray<BrickCells>& cells, SubtreeCells& made,
                   SurfaceVertices& vertices);

private:
    void list_candidates(const FilledSubtree& in, std::uint32_t brick, bool parted);
    void add_along_walls(const BrickCells& cells, const SubtreeCells& made, std::uint32_t brick);
    void add_around_hanging_corners(const BrickCells& cells, const SubtreeCells& made, std::uint32_t brick);
    [[nodiscard]] bool goes_on(const FilledSubtree& in, std::uint32_t brick, GridBits points, bool inside,
                               bool may_look_beyond);
    [[nodiscard]] bool goes_on_in(const Octree& octree, const Brick& brick, const std::array<glm::ivec3, 4>& line,
                                  bool inside);
    [[nodiscard]] bool has_axis(const Octree& octree, std::uint32_t brick, const Bounds<glm::ivec3>& box) const;
    [[nodiscard]] bool is_speck(const Octree& octree, const LoopWalk::Part& part, LoopWalk::Kind kind) const;
    void find(const FilledSubtree& in);
    void mark_edges(const Octree& octree, std::uint32_t subtree, ChunkedArray<BrickCells>& cells,
                    SubtreeCells& made) const;

    const field::Skeleton& skeleton_;
    std::unique_ptr<field::BrickField> beyond_; // in bricks beyond the subtree
    float isovalue_;
    bool looked_beyond_ = false;
    LoopWalk walk_;
    struct Candidate {
        LoopPlace loop;
        LoopWalk::Kind kind = LoopWalk::Kind::kAny;
    };
    std::vector<Candidate> candidates_; // of a brick: one loop or more of all specks that it may have
    std::vector<LoopPlace> loops_;      // of specks, in the subtree's bricks or beyond
    std::vector<LoopEdge> edges_;       // of them
};

} // namespace ramus::mesh::bricks
