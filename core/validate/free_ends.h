// Where vessels end free: a tree does not say what lies beyond. The surface reaches 0.7075 radii beyond the end there
// (the paper's kernel: half a line's sum), half a ball a whole radius. mm, RAS.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::validate {

class FreeEnds {
public:
    explicit FreeEnds(const tree::VesselTree& tree);
    // Whether a place of this branch's surface lies beyond one of its free ends.
    [[nodiscard]] bool beyond(int branch, const glm::dvec3& at) const;

private:
    struct End {
        tree::Point point;
        glm::dvec3 out{0.0}; // unit length
    };
    std::vector<std::vector<End>> ends_; // by branch
};

} // namespace ramus::validate
