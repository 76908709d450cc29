// Axes: the segments of a tree's centerlines in a bounding-volume hierarchy, for intersection tests. Positions are in
// mm.
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
    // The tree must outlive the object.
    explicit Axes(const tree::VesselTree& tree);

    // Whether any axis has a point in a box.
    [[nodiscard]] bool reach(const Bounds<glm::dvec3>& box) const;
    // Whether any axis intersects the triangles that span a closed line (spanning_triangles.h).
    [[nodiscard]] bool go_through(std::span<const glm::dvec3> line) const;

private:
    using Segment = std::array<std::uint32_t, 2>; // points of the tree

    const tree::VesselTree& tree_;
    std::vector<Segment> segments_;
    BoxTree boxes_; // of segments
};

} // namespace ramus::mesh
