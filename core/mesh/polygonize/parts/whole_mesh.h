// WholeMesh: where the parts of a surface go in the mesh of all of them, which the leader of a team receives.
#pragma once

#include "core/base/team.h"
#include "core/mesh/polygonize/parts/part_making.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// Where all subtrees have their vertices and triangles in the whole mesh: in the order of SurfaceBatches.
struct WholeMesh {
    WholeMesh(std::span<const SubtreeBatch> schedule, std::span<const SubtreeCounts> counts);

    std::vector<SubtreePlaces> places; // by subtree
    std::uint64_t vertices = 0, triangles = 0;
};

// Renumbers the vertices of the triangles of a part by those of the whole mesh. `counts`: of all subtrees.
void renumber_for_whole(PartMaking& making, std::span<const SubtreeCounts> counts, const WholeMesh& whole);

// Gives the leader the parts of all, renumbered before. Empty for the others.
[[nodiscard]] TriangleMesh gather(Team& team, PartMaking& making, std::span<const SubtreeCounts> counts,
                                  const WholeMesh& whole, const LargeAllocator<std::byte>& memory);

} // namespace ramus::mesh::bricks
