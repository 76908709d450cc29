// A part of a surface, as one of several processes makes it: the triangles of consecutive subtrees of the octree. What
// lies at its border is computed by both sides, to the same bits, so that nobody waits for anybody.
//
// Together: polygonize_together() puts the parts of a team into one mesh, which has the bytes of polygonize().
#pragma once

#include "core/base/team.h"
#include "core/mesh/polygonize/polygonize.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::mesh {

// Which part: `index` of `count` parts with equal shares of the estimated work.
struct PartOf {
    std::size_t index = 0, count = 1;
};

struct PartStatistics : PolygonizeStatistics {
    std::uint64_t border_evaluations = 0; // of subtrees that belong to other parts
    double share = 0.0;                   // of the estimated work
    double find_s = 0.0;                  // of `bricks_s`: finding all subtrees, which a team divides

    void add(const PartStatistics& more); // of another vessel system
};

// The part as a mesh with a border: its triangles, and the vertices that they have. Fails as polygonize() does.
[[nodiscard]] Result<TriangleMesh> polygonize_part(const field::Field& field, const PolygonizeOptions& options,
                                                   const PartOf& part, Job& job, PartStatistics* statistics = nullptr);

// The whole surface, in the memory of the options of the leader; empty for the others. All processes must have the same
// field and options but for `disk` and `memory_bytes`. If one fails, all fail, with the error of the first one.
[[nodiscard]] Result<TriangleMesh> polygonize_together(const field::Field& field, const PolygonizeOptions& options,
                                                       Team& team, Job& job, PartStatistics* statistics = nullptr,
                                                       std::vector<Bounds<glm::vec3>>* walled = nullptr);

} // namespace ramus::mesh
