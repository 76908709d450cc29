// FreeEnds: recognises the parts of a surface beyond the free ends of vessels, where the tree gives no information. The
// convolution surface reaches 0.7075 radii beyond a free end (width 5), a half sphere one radius. Positions in mm, RAS.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::validate {

class FreeEnds {
public:
    explicit FreeEnds(const tree::VesselTree& tree);
    // Whether a point of the surface of a branch lies beyond one of the branch's free ends.
    [[nodiscard]] bool beyond(int branch, const glm::dvec3& at) const;

private:
    struct End {
        tree::Point point;
        glm::dvec3 out{0.0}; // unit length
    };
    std::vector<std::vector<End>> ends_; // by branch
};

} // namespace ramus::validate
