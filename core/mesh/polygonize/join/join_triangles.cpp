#include "core/mesh/polygonize/join/join_triangles.h"

#include <atomic>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

void join_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedSubtree>& joined,
                   const JobRange& job) {
    joined.resize(subtrees.size());
    std::atomic<std::size_t> done{0};
    const EdgePolygons general(field, octree, surface, vertices);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        const Subtree& subtree = octree.subtrees[subtrees[t]];
        joined[t].clear();
        // Euler: about as many quads as vertices.
        joined[t].quads.reserve(surface.subtrees[subtrees[t]].vertex_count * 9 / 8 + 64);
        join_bricks(surface, general, subtree.first_brick, subtree.first_brick + subtree.brick_count, joined[t]);
        job.report(static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
}

} // namespace ramus::mesh::bricks
