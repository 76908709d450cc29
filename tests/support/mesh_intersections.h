// The pairs of triangles of a mesh that intersect beyond the corners that they share (exact_triangles.h), found with a
// bounding-volume hierarchy, in threads.
#pragma once

#include "core/base/bounds.h"
#include "core/base/halved_boxes.h"
#include "core/base/lists_by_thread.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/exact_triangles.h"
#include "core/mesh/untangle/intersecting_triangles.h"

#include <cstdint>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::test {

// All triangles of a mesh, to find those near a box. Not the hierarchy of the code that is tested (box_tree.h).
class TriangleFinder {
public:
    using Box = Bounds<glm::dvec3>;

    explicit TriangleFinder(const mesh::TriangleMesh& mesh) : boxes_(mesh.triangles.size()) {
        for (std::size_t n = 0; n < boxes_.size(); ++n)
            for (int i = 0; i < 3; ++i) boxes_[n].hold(glm::dvec3(mesh.positions[mesh.triangles[n][i]]));
        tree_ = halved_boxes(
            static_cast<std::uint32_t>(boxes_.size()),
            [&](Box& all, std::uint32_t triangle) { all.hold(boxes_[triangle]); },
            [&](std::uint32_t triangle, int axis) {
                return boxes_[triangle].least[axis] + boxes_[triangle].most[axis];
            });
    }
    [[nodiscard]] const Box& box(std::uint32_t triangle) const { return boxes_[triangle]; }
    // Calls call(triangle) for each triangle whose box meets this one.
    template <class Call> void for_each_in(const Box& box, const Call& call) const {
        std::vector<std::uint32_t> open;
        if (!tree_.nodes.empty()) open.push_back(0);
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            const BoxNode& node = tree_.nodes[at];
            if (!node.box.meets(box)) continue;
            if (node.count == 0) open.push_back(at + 1), open.push_back(node.first);
            for (std::uint32_t n = node.first; n < node.first + node.count; ++n)
                if (boxes_[tree_.order[n]].meets(box)) call(tree_.order[n]);
        }
    }

private:
    std::vector<Box> boxes_; // by triangle
    HalvedBoxes tree_;
};

using IntersectingPair = mesh::TrianglePair; // triangles, the lower first

[[nodiscard]] inline std::vector<IntersectingPair> intersecting_triangles(const mesh::TriangleMesh& mesh) {
    const TriangleFinder tree(mesh);
    ListsByThread<IntersectingPair> found;
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(mesh.triangles.size()), [&](std::uint32_t n) {
        tree.for_each_in(tree.box(n), [&](std::uint32_t other) {
            if (other > n && mesh::triangles_meet(mesh.positions, mesh.triangles[n], mesh.triangles[other]))
                found.local().push_back({n, other});
        });
    });
    return found.sorted();
}

// The middle of the two triangles of a pair, mm.
[[nodiscard]] inline glm::dvec3 middle_of(const mesh::TriangleMesh& mesh, const IntersectingPair& pair) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t triangle : {pair.first, pair.second})
        for (int i = 0; i < 3; ++i) sum += glm::dvec3(mesh.positions[mesh.triangles[triangle][i]]);
    return sum / 6.0;
}

} // namespace ramus::test
