// Axes: those of a tree's vessels, as segments in a tree of boxes.
#pragma once

#include "core/base/bounds.h"
#include "core/base/box_tree.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

class Axes {
public:
    // Of a tree, which must outlive them.
    explicit Axes(const tree::VesselTree& tree);

    // Whether one has a point in a box.
    [[nodiscard]] bool reach(const Bounds<glm::dvec3>& box) const;
    // Whether one goes through the triangles that span a closed line (spanning_triangles.h).
    [[nodiscard]] bool go_through(std::span<const glm::dvec3> line) const;

private:
    using Segment = std::array<std::uint32_t, 2>; // points of the tree

    const tree::VesselTree& tree_;
    std::vector<Segment> segments_;
    BoxTree boxes_; // of segments
};

} // namespace ramus::mesh
