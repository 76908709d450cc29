// Opens lost loops: cycles of a tree whose hole is closed in the surface. If vessels are nearly as thick as their cycle
// is wide, the field has no hole. A tunnel between two triangles adds the loop to the surface.
#pragma once

#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace ramus::mesh {

struct OpenedLoops {
    std::size_t opened = 0;
    std::vector<glm::vec3> closed; // the middles of holes that stay closed, mm, RAS

    void add(const OpenedLoops& more) {
        opened += more.opened;
        closed.insert(closed.end(), more.closed.begin(), more.closed.end());
    }
};

// Opens a straight tunnel through the hole of each cycle of `tree` whose hole lies inside the closed surface, until
// `lost_loops` loops are added. The radius of a tunnel is at most half of the distance of its middle from the
// centerlines, and its mouths fit into one triangle each. Other triangles do not change. If arrays need more than
// `memory_bytes`, they are on `disk`; without a disk nothing is opened. If cancelled, the remaining cycles are skipped.
[[nodiscard]] OpenedLoops open_lost_loops(TriangleMesh& mesh, const tree::VesselTree& tree, std::size_t lost_loops,
                                          double memory_bytes, Job& job, const std::shared_ptr<ArrayMemory>& disk = {});

} // namespace ramus::mesh
