// Sheet: a smooth surface that divides space, as a height field over a plane. The heights are a uniform bicubic
// B-spline with a grid of control points. Moving a control point changes the surface within two grid steps around it.
// Beyond the grid the control heights continue linearly, so that a sheet has no border and always divides an organ.
//
// Units: mm. Source of the smoothing: P. Eilers and B. Marx, "Flexible smoothing with B-splines and penalties", 1996,
// in two dimensions with the penalty of a thin plate.
#pragma once

#include "core/base/bounds.h"
#include "core/base/error.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::organ {

struct Sheet {
    // Control point (i, j) lies above origin + i * step.x * u + j * step.y * v, by its height along cross(u, v). u and
    // v are of unit length and at right angles.
    glm::dvec3 origin{0.0}, u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0};
    glm::dvec2 step{1.0};
    glm::ivec2 size{0};          // number of control points along u and v, at least 2 each
    std::vector<double> heights; // along u fastest
    // Removed is the side to which cross(u, v) points, or the other one.
    bool removes_below = false;

    [[nodiscard]] glm::dvec3 normal() const { return glm::cross(u, v); }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) + static_cast<std::size_t>(size.x) * static_cast<std::size_t>(j);
    }
    [[nodiscard]] glm::dvec3 control_point(int i, int j) const {
        return origin + i * step.x * u + j * step.y * v + heights[index(i, j)] * normal();
    }
    bool operator==(const Sheet&) const = default;
};

// Fails unless the axes, the steps and the number of heights are as described above.
[[nodiscard]] Result<void> check_sheet(const Sheet& sheet);

// The height of the surface above the base plane at a point of it, mm along u and v from the origin.
[[nodiscard]] double height_at(const Sheet& sheet, const glm::dvec2& place);
// The height of a point above the surface, along the normal of the base plane. Not the distance, but never less.
[[nodiscard]] double height_above(const Sheet& sheet, const glm::dvec3& point);
// An upper bound of the length of the gradient of height_above() within a box.
[[nodiscard]] double steepest_in(const Sheet& sheet, const Bounds<glm::dvec3>& box);

struct SheetFit {
    glm::ivec2 size{8};      // control points along each axis, 4 to 32
    double smoothing = 1e-3; // weight of the bending energy against the squared distances of the contour, per point
};

// The sheet through a contour: points on the surface of the organ, in any order, three or more. Its base plane is the
// best-fitting plane of the points, its grid covers them. Between the points the sheet bends as little as possible. For
// a smooth contour it passes the points within hundredths of a mm; a contour that the grid cannot follow is smoothed.
// Fails if the points lie on a line.
[[nodiscard]] Result<Sheet> sheet_through(std::span<const glm::dvec3> contour, const SheetFit& fit = {});

// The sheet, bent so that it passes through places, one or more, with the least change of control heights: nothing
// changes farther away than four grid steps. One place is met within 0.1 % of the change; places that the grid cannot
// follow are smoothed. The grid grows where places lie beyond it, which alone does not change the surface. Fails if it
// would have more than 32 control points along an axis.
[[nodiscard]] Result<Sheet> bent_through(const Sheet& sheet, std::span<const glm::dvec3> places);

} // namespace ramus::organ
