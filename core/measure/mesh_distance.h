// MeshDistance: how far things lie from a closed triangle mesh; 0 inside. A tree of boxes over the triangles answers in
// microseconds. Inside is where the surface winds around the point (so solids may overlap, and a shell turned inward
// makes a hole), told along a ray, and along another one where that grazes an edge. Immutable; any number of threads
// may ask. Distances are those to the triangles, exact but for rounding; quick where `best` is near the answer.
#pragma once

#include "core/base/bounds.h"
#include "core/base/halved_boxes.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::measure {

class MeshDistance {
public:
    // Of the mesh's positions and triangles; the mesh need not outlive it. The mesh has a triangle at least.
    explicit MeshDistance(const mesh::TriangleMesh& mesh);

    // mm from the nearest point of the solid: 0 inside.
    [[nodiscard]] double distance(const glm::dvec3& point) const;
    [[nodiscard]] bool inside(const glm::dvec3& point) const;
    // Of the surface, inside too.
    [[nodiscard]] double surface_distance(const glm::dvec3& point) const;
    [[nodiscard]] glm::dvec3 nearest_on_surface(const glm::dvec3& point) const;
    // The least of `best` and, over all places of the segment, (surface distance) - (radius there, linear between the
    // ends): negative where the vessel's wall goes through the surface. To within 1e-9 mm, but for rounding; quick
    // where `best` is near the answer.
    [[nodiscard]] double wall_distance(const tree::Point& a, const tree::Point& b, double best) const;

    using Box = Bounds<glm::dvec3>;
    [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }
    [[nodiscard]] std::size_t triangle_count() const { return corners_.size(); }

private:
    using Triangle = std::array<glm::dvec3, 3>;
    template <class ToBox, class ToTriangle>
    [[nodiscard]] double least(double best, double enough, const ToBox& to_box, const ToTriangle& to_triangle) const;
    [[nodiscard]] int winding(const glm::dvec3& point, const glm::dvec3& direction, bool& grazed) const;

    std::vector<BoxNode> nodes_;
    std::vector<Triangle> corners_; // in the order of the leaves
};

} // namespace ramus::measure
