// MeshDistance: distances (mm) of points and vessel segments from a closed triangle mesh; 0 inside. A bounding-volume
// hierarchy over the triangles answers a query in microseconds. A point is inside if its winding number is positive, so
// solids may overlap, and a shell that faces inward is a cavity. The winding number is computed along a ray; if the ray
// touches an edge, along another one. Immutable and safe for concurrent use. Distances are to the triangles, exact up
// to rounding.
#pragma once

#include "core/base/bounds.h"
#include "core/base/halved_boxes.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::measure {

class MeshDistance {
public:
    // Copies the triangles of the mesh, which must have at least one.
    explicit MeshDistance(const mesh::TriangleMesh& mesh);

    // The distance from the solid: 0 inside.
    [[nodiscard]] double distance(const glm::dvec3& point) const;
    [[nodiscard]] bool inside(const glm::dvec3& point) const;
    // The distance from the surface, also for points inside.
    [[nodiscard]] double surface_distance(const glm::dvec3& point) const;
    [[nodiscard]] glm::dvec3 nearest_on_surface(const glm::dvec3& point) const;
    // The minimum of `best` and of (surface distance) - (radius, linear between the ends) over all places of the
    // segment. Negative if the vessel's wall passes through the surface. The error is below 1e-9 mm, up to rounding.
    // Fast if `best` is near the result.
    [[nodiscard]] double wall_distance(const tree::Point& a, const tree::Point& b, double best) const;

    // The nearest places of a triangle and of the surface. None: they are not nearer to each other than `best`.
    struct Gap {
        double distance_mm = 0.0; // 0: the two meet
        glm::dvec3 on_triangle{0.0}, on_surface{0.0};
    };
    [[nodiscard]] std::optional<Gap> triangle_gap(const std::array<glm::dvec3, 3>& triangle, double best) const;

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
