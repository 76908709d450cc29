// TriangleBoxes: a bounding-volume hierarchy over the triangles of a surface. Its leaves are groups of consecutive
// triangles: consecutive triangles of a surface are close in space, so no sorting is needed.
#pragma once

#include "core/base/box_tree.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <utility>

namespace ramus::mesh {

using TriangleBox = EightBoxes::Box; // mm

[[nodiscard]] inline TriangleBox box_of(std::span<const glm::vec3> positions, const glm::uvec3& triangle) {
    TriangleBox box;
    for (int corner = 0; corner < 3; ++corner) box.hold(positions[triangle[corner]]);
    return box;
}

class TriangleBoxes {
public:
    static constexpr std::size_t kGroup = 8; // triangles
    using Groups = BoxTree::Level;

    // The surface must outlive the object.
    explicit TriangleBoxes(const TriangleMesh& mesh) : TriangleBoxes(mesh.positions, mesh.triangles, mesh.memory()) {}
    TriangleBoxes(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                  const Groups::allocator_type& memory = {})
        : TriangleBoxes(positions, triangles,
                        groups_of(
                            positions, triangles, [](std::size_t) {}, memory)) {}
    // The same with the boxes of groups from groups_of().
    TriangleBoxes(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles, Groups groups)
        : positions_(positions), triangles_(triangles), tree_(std::move(groups)) {}

    // The boxes of all groups. Also calls call(triangle) for each triangle, in several threads.
    template <class Call>
    [[nodiscard]] static Groups groups_of(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                                          const Call& call, const Groups::allocator_type& memory = {}) {
        const auto box_of_group = [&](std::size_t group) {
            TriangleBox box;
            for (std::size_t n = kGroup * group; n < std::min(kGroup * (group + 1), triangles.size()); ++n) {
                box.hold(box_of(positions, triangles[n]));
                call(n);
            }
            return box;
        };
        return BoxTree::level_of((triangles.size() + kGroup - 1) / kGroup, box_of_group, memory);
    }

    [[nodiscard]] std::span<const glm::vec3> positions() const { return positions_; }
    [[nodiscard]] std::span<const glm::uvec3> triangles() const { return triangles_; }
    [[nodiscard]] TriangleBox box(std::size_t triangle) const { return box_of(positions_, triangles_[triangle]); }

    // Calls call(group, its box) for each group whose box intersects `box`, ascending.
    template <class Call> void for_each_group_in(const TriangleBox& box, const Call& call) const {
        tree_.for_each_meeting(box, [&](std::size_t group) { call(group, tree_.box(group)); });
    }
    // Calls call(triangle) for each triangle of a group.
    template <class Call> void for_each_of(std::size_t group, const Call& call) const {
        const std::size_t end = std::min(kGroup * (group + 1), triangles_.size());
        for (std::size_t n = kGroup * group; n < end; ++n) call(static_cast<std::uint32_t>(n));
    }
    // Calls call(triangle) for each triangle whose box intersects `box`, ascending.
    template <class Call> void for_each_in(const TriangleBox& box, const Call& call) const {
        for_each_group_in(box, [&](std::size_t group, const TriangleBox& around) {
            const bool all = box.contains(around); // then the boxes of single triangles need no test
            for_each_of(group, [&](std::uint32_t n) {
                if (all || this->box(n).meets(box)) call(n);
            });
        });
    }
    // Sets marks[n] to `mark` for each triangle n whose box intersects one of box_of(0) to box_of(count - 1), unless it
    // is marked (not Mark()). Calls box_of in several threads.
    template <class BoxOf, class Mark>
    void mark_in(std::size_t count, const BoxOf& box_of, LargeArray<Mark>& marks, Mark mark) const {
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t place) {
            const TriangleBox box = box_of(place);
            for_each_group_in(box, [&](std::size_t group, const TriangleBox& around) {
                const bool all = box.contains(around);
                for_each_of(group, [&](std::uint32_t n) {
                    const std::atomic_ref<Mark> one(marks[n]);
                    if (one.load(std::memory_order_relaxed) != Mark()) return; // no need of its box
                    if (all || this->box(n).meets(box)) one.store(mark, std::memory_order_relaxed);
                });
            });
        });
    }

private:
    std::span<const glm::vec3> positions_;
    std::span<const glm::uvec3> triangles_;
    BoxTree tree_; // of groups
};

} // namespace ramus::mesh
