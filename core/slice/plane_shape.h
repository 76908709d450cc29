// ShapeFigures: area, diameters and centroid of a shape in a plane that loops enclose, holes subtracted.
//
// The least and the largest diameter are caliper (Feret) diameters: the least and the largest distance of two parallel
// lines that touch the shape from both sides. They are exact for the polygon, by rotating calipers on its convex hull
// (M. I. Shamos, Computational Geometry, 1978). The equivalent diameter is that of a disc of the same area. Holes do
// not change calipers. Units: mm, mm2.
#pragma once

#include "core/slice/section.h"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace ramus::slice {

struct ShapeFigures {
    double area_mm2 = 0.0;
    double equivalent_mm = 0.0, least_mm = 0.0, largest_mm = 0.0; // diameters
    glm::dvec3 centroid{0.0};
};

// The figures of the disc of a diameter.
[[nodiscard]] ShapeFigures figures_of_disc(double diameter_mm);

// `loops`: outer loops counter-clockwise about the normal, holes clockwise. Open loops count as closed by a straight
// line. Zero without an area.
[[nodiscard]] ShapeFigures figures_of(std::span<const Loop> loops, const Plane& plane);

// A loop in coordinates of its plane: about `plane.point`, along two unit vectors at right angles whose cross product
// is the normal.
struct PlaneAxes {
    glm::dvec3 origin, u, v;
    explicit PlaneAxes(const Plane& plane);
    [[nodiscard]] glm::dvec2 on(const glm::dvec3& at) const {
        return {glm::dot(at - origin, u), glm::dot(at - origin, v)};
    }
    [[nodiscard]] glm::dvec3 place(const glm::dvec2& at) const { return origin + at.x * u + at.y * v; }
};
using Outline = std::vector<glm::dvec2>;
[[nodiscard]] Outline outline_of(const Loop& loop, const PlaneAxes& axes);

// Twice the signed area, and whether a point is inside by the even-odd rule.
[[nodiscard]] double twice_area(const Outline& outline);
[[nodiscard]] bool encloses(const Outline& outline, const glm::dvec2& at);

// Counter-clockwise, without points on straight lines.
[[nodiscard]] Outline convex_hull(Outline points);

struct Calipers {
    double least = 0.0, largest = 0.0;
};
[[nodiscard]] Calipers calipers_of(const Outline& hull);

} // namespace ramus::slice
