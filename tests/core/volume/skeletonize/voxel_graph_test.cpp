// Graphs of skeletons whose voxels meet in threes.
#include "core/base/disjoint_sets.h"
#include "core/volume/skeletonize/voxel_graph.h"
#include "tests/support/mask.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;

namespace {

struct Counts {
    std::size_t pieces = 0, loops = 0;
    bool operator==(const Counts&) const = default;
};

Counts counts_of(const std::vector<glm::ivec3>& voxels, const glm::dvec3& spacing) {
    const volume::BitMask mask =
        test::mask_of({5, 5, 5}, [&](const glm::ivec3& voxel) { return std::ranges::count(voxels, voxel) > 0; });
    const volume::VoxelSet set(mask, spacing);
    const LargeArray<float> distances(set.count(), 1.0F);
    const volume::VoxelGraph graph = volume::graph_of(set.bits(), set, distances);
    DisjointSets joined(graph.nodes.size());
    for (const volume::VoxelGraph::Line& line : graph.lines)
        joined.join(static_cast<std::uint32_t>(line.from), static_cast<std::uint32_t>(line.to));
    return {joined.count(), graph.lines.size() + joined.count() - graph.nodes.size()};
}

} // namespace

TEST_CASE("voxels that all touch each other are one piece without a loop, whichever are nearest") {
    const std::vector<glm::ivec3> three = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
    // Two ends and a knot, from which a line goes on. Beside each other ends are nearest, or either of them to the
    // knot.
    const std::vector<glm::ivec3> going_on = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {0, 3, 2}, {0, 4, 3}};
    const std::vector<glm::ivec3> corner = {{1, 1, 1}, {2, 2, 1}, {2, 1, 2}, {3, 2, 3}, {3, 3, 4}};
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(2.0, 1.0, 1.0), glm::dvec3(1.0, 2.0, 1.0),
                                     glm::dvec3(1.0, 1.0, 0.2), glm::dvec3(3.0, 1.0, 2.0)}) {
        CAPTURE(spacing.x);
        CAPTURE(spacing.y);
        CHECK(counts_of(three, spacing) == Counts{1, 0});
        CHECK(counts_of(going_on, spacing) == Counts{1, 0});
        CHECK(counts_of(corner, spacing) == Counts{1, 0});
    }
}
