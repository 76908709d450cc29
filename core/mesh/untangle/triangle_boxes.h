// TriangleBoxes: boxes around the triangles of a surface, in groups as they follow each other, and around ever more of
// these groups. A surface's triangles lie beside those that come before and after them, so groups need no sorting.
#pragma once

#include "core/base/eight_boxes.h"
#include "core/base/large_array.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace ramus::mesh {

using TriangleBox = EightBoxes::Box; // mm

[[nodiscard]] inline TriangleBox box_of(const TriangleMesh& mesh, const glm::uvec3& triangle) {
    TriangleBox box;
    for (int corner = 0; corner < 3; ++corner) box.hold(mesh.positions[triangle[corner]]);
    return box;
}
[[nodiscard]] inline bool boxes_meet(const TriangleBox& a, const TriangleBox& b) {
    bool meet = true; // no test depends on another
    for (int axis = 0; axis < 3; ++axis) {
        meet &= a.least[axis] <= b.most[axis];
        meet &= b.least[axis] <= a.most[axis];
    }
    return meet;
}

class TriangleBoxes {
public:
    static constexpr std::size_t kGroup = 8; // triangles
    using Groups = LargeArray<EightBoxes>;

    // Boxes of groups of a surface, which must outlive this.
    TriangleBoxes(const TriangleMesh& mesh, Groups groups) : mesh_(&mesh) {
        levels_.push_back(std::move(groups));
        while (levels_.back().size() > 1) {
            const Groups& below = levels_.back();
            Groups level((below.size() + EightBoxes::kCount - 1) / EightBoxes::kCount, EightBoxes());
            for (std::size_t n = 0; n < below.size(); ++n)
                level[n / EightBoxes::kCount].set(n % EightBoxes::kCount, below[n].around());
            levels_.push_back(std::move(level));
        }
    }

    // Calls call(triangle) for those whose boxes meet this one, ascending.
    template <class Call> void for_each_in(const TriangleBox& box, const Call& call) const {
        if (!levels_.front().empty()) look(levels_.size() - 1, 0, box, call);
    }

private:
    template <class Call> void look(std::size_t level, std::size_t at, const TriangleBox& box, const Call& call) const {
        for (unsigned bits = levels_[level][at].meeting(box); bits != 0; bits &= bits - 1) {
            const std::size_t below = EightBoxes::kCount * at + static_cast<std::size_t>(std::countr_zero(bits));
            if (level > 0) {
                look(level - 1, below, box, call);
                continue;
            }
            const std::size_t end = std::min(kGroup * (below + 1), mesh_->triangles.size());
            for (std::size_t n = kGroup * below; n < end; ++n)
                if (boxes_meet(box_of(*mesh_, mesh_->triangles[n]), box)) call(static_cast<std::uint32_t>(n));
        }
    }

    const TriangleMesh* mesh_;
    std::vector<Groups> levels_; // the lowest first
};

} // namespace ramus::mesh
