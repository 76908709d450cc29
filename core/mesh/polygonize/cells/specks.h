// Specks: finds and removes small closed parts of the surface, of a few cells, that belong to no vessel.
//
// Specks have two causes. Next to a wall, the region of a vessel may end in a ridge thinner than a cell. If the ridge
// passes a grid point, or the wall passes a single edge, a separate piece of surface or a cavity arises. Where vessels
// come close to each other near a joint, the sum may rise above the isovalue, or fall below it, around a single grid
// point.
//
// A small closed part is a speck if it encloses the outside (a cavity), if no axis passes through it, or if it is too
// small for its vessel and vessels are kept apart in all of its bricks. If some of its bricks keep no vessels apart, it
// is removed only if it lies within one subtree, so that such subtrees do not depend on each other.
#pragma once

#include "core/base/bounds.h"
#include "core/mesh/polygonize/cells/circuit_walk.h"

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

    // Removes the specks of a subtree that has just been filled. The subtree's vertices must be the last ones of
    // `vertices`. `parted`: the bricks of the subtree in which vessels are kept apart, descending.
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
    [[nodiscard]] bool is_speck(const Octree& octree, const CircuitWalk::Part& part, CircuitWalk::Kind kind) const;
    void find(const FilledSubtree& in);
    void mark_edges(const Octree& octree, std::uint32_t subtree, ChunkedArray<BrickCells>& cells,
                    SubtreeCells& made) const;

    const field::Skeleton& skeleton_;
    std::unique_ptr<field::BrickField> beyond_; // for bricks beyond the subtree
    float isovalue_;
    bool looked_beyond_ = false;
    CircuitWalk walk_;
    struct Candidate {
        CircuitPlace circuit;
        CircuitWalk::Kind kind = CircuitWalk::Kind::kAny;
    };
    std::vector<Candidate> candidates_;  // of a brick: at least one circuit of each speck that it may have
    std::vector<CircuitPlace> circuits_; // the circuits of specks, in the subtree's bricks or beyond
    std::vector<CircuitEdge> edges_;     // the edges of specks
};

} // namespace ramus::mesh::bricks
