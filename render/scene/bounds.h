// Box: an axis-aligned box in mm (RAS), for fitting cameras and placing planes. An empty box contains nothing; centre()
// and radius() then answer as for a unit box at the origin, so that an empty scene still has a picture.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "render/scene/centerlines.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace ramus::render {

struct Box {
    glm::dvec3 lower{1.0};
    glm::dvec3 upper{-1.0};

    [[nodiscard]] bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    [[nodiscard]] glm::dvec3 centre() const;
    [[nodiscard]] double radius() const; // of the circumscribed sphere, never 0
    void include(const glm::dvec3& point);
    bool operator==(const Box&) const = default;
};

[[nodiscard]] Box bounds_of(const mesh::TriangleMesh& mesh);
[[nodiscard]] Box bounds_of(const tree::VesselTree& tree); // of its points
[[nodiscard]] Box bounds_of(const Centerlines& lines);     // of the vessels: of balls around every point

// Whether the box with these corners may intersect the picture of `to_clip`. Conservative.
[[nodiscard]] bool in_picture(const glm::vec3& lower, const glm::vec3& upper, const glm::dmat4& to_clip);

} // namespace ramus::render
