// A surface's pieces and loops, made those of its tree: false pieces are dropped, false loops cut and lost ones opened.
#pragma once

#include "core/mesh/loops/cut_false_loops.h"
#include "core/mesh/loops/open_lost_loops.h"

namespace ramus::mesh {

struct MatchedTree {
    std::size_t dropped = 0; // pieces (drop_false_pieces.h)
    CutLoops false_loops;    // cut_false_loops.h
    OpenedLoops lost_loops;  // open_lost_loops.h

    [[nodiscard]] bool changed() const { return dropped > 0 || false_loops.cut > 0 || lost_loops.opened > 0; }
    void add(const MatchedTree& more) {
        dropped += more.dropped;
        false_loops.add(more.false_loops), lost_loops.add(more.lost_loops);
    }
};

// Whether a closed surface has as many pieces and loops as its tree. Triangles that have one vertex twice do not count,
// nor do vertices that none has. Takes 25 ns for each triangle.
[[nodiscard]] bool matches_tree(const TriangleMesh& mesh, const tree::VesselTree& tree);

// Of a closed surface in which all vertices have triangles. `walls`: boxes, mm, that hold all walls between vessels.
// `disk`: for what takes more than `memory_bytes`; may be null.
[[nodiscard]] MatchedTree match_tree(TriangleMesh& mesh, const tree::PreparedTree& tree,
                                     std::span<const Bounds<glm::vec3>> walls, double memory_bytes, Job& job,
                                     const std::shared_ptr<ArrayMemory>& disk = {});

} // namespace ramus::mesh
