// Repairs the topology of a surface so that it has the pieces and loops of its tree: removes false pieces, cuts false
// loops and opens lost loops.
#pragma once

#include "core/mesh/loops/cut_false_loops.h"
#include "core/mesh/loops/open_lost_loops.h"

namespace ramus::mesh {

struct MatchedTree {
    std::size_t dropped = 0; // number of removed pieces (drop_false_pieces.h)
    CutLoops false_loops;    // cut_false_loops.h
    OpenedLoops lost_loops;  // open_lost_loops.h

    [[nodiscard]] bool changed() const { return dropped > 0 || false_loops.cut > 0 || lost_loops.opened > 0; }
    void add(const MatchedTree& more) {
        dropped += more.dropped;
        false_loops.add(more.false_loops), lost_loops.add(more.lost_loops);
    }
};

// Whether a closed surface has as many pieces and loops as its tree. Ignores unused vertices, and triangles whose first
// two vertices are equal. Takes 25 ns for each triangle.
[[nodiscard]] bool matches_tree(const TriangleMesh& mesh, const tree::VesselTree& tree);

// Repairs a closed surface in which every vertex belongs to a triangle. `walls`: boxes (mm) that contain all walls
// between vessels. `disk`: the place of arrays that need more than `memory_bytes`; may be null. Not guaranteed: that
// the result matches the tree; MatchedTree reports what is left.
[[nodiscard]] MatchedTree match_tree(TriangleMesh& mesh, const tree::PreparedTree& tree,
                                     std::span<const Bounds<glm::vec3>> walls, double memory_bytes, Job& job,
                                     const std::shared_ptr<ArrayMemory>& disk = {});

} // namespace ramus::mesh
