// Lost loops: cycles of a tree whose hole its surface has closed. Where vessels are nearly as thick as their cycle is
// wide, the field has no hole left; a tunnel between two triangles gives the surface the loop.
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
    std::vector<glm::vec3> closed; // in the middle of holes that stay closed, mm, RAS

    void add(const OpenedLoops& more) {
        opened += more.opened;
        closed.insert(closed.end(), more.closed.begin(), more.closed.end());
    }
};

// Opens a tunnel through the middle of each cycle whose hole lies inside a closed surface, until it has as many more
// loops. A tunnel is half as wide as the way from its middle to the centerlines at the most, and a
// triangle wide at the most. Other triangles stay as they are. `tree`: what the surface was made of. Where it would
// take more than `memory_bytes`, its arrays are on `disk`; without one it does nothing, nor if cancelled.
[[nodiscard]] OpenedLoops open_lost_loops(TriangleMesh& mesh, const tree::VesselTree& tree, std::size_t lost_loops,
                                          double memory_bytes, Job& job, const std::shared_ptr<ArrayMemory>& disk = {});

} // namespace ramus::mesh
