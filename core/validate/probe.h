// Probe: queries of a surface at a place: whether the place is inside, and the cross-section there. Lengths are in mm.
// Inside is the median of the winding numbers along five rays. So solids may overlap, as truncated cones do, and the
// surface may have holes, as at open ends of vessels. Safe for concurrent use.
#pragma once

#include "core/measure/deviation/packed_triangles.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::validate {

struct Place;

struct CrossSection {
    bool inside = false;
    // The radius of a circle of the same area; 0 outside. `flat_radius` is measured on the flat triangles, which are
    // chords of the surface; `radius` on triangles that are curved according to their vertex normals.
    double radius = 0.0, flat_radius = 0.0;
    glm::dvec3 middle{0.0}; // centroid of the area
};

class Probe {
public:
    // `places`: places that should be inside; they show whether the surface is inside out. The surface must outlive the
    // object.
    Probe(const mesh::TriangleMesh& surface, std::span<const Place> places);

    // The cross-section perpendicular to `direction`, limited to a distance of `reach` mm.
    [[nodiscard]] CrossSection cross_section(const glm::dvec3& at, const glm::dvec3& direction, double reach) const;
    [[nodiscard]] bool inside(const glm::dvec3& at) const;
    // Whether the straight way between two places does not intersect the surface.
    [[nodiscard]] bool sees(const glm::dvec3& from, const glm::dvec3& to) const;

private:
    [[nodiscard]] int winding(const glm::dvec3& at) const;
    [[nodiscard]] const measure::Crossing* way_out(std::span<const measure::Crossing> crossings, int turns,
                                                   const glm::dvec3& far) const;
    [[nodiscard]] double bulge(const measure::Crossing& crossing, const glm::dvec3& from, const glm::dvec3& way) const;

    const mesh::TriangleMesh& surface_;
    measure::PackedTriangles triangles_;
    double size_; // diagonal of the surface's bounding box, mm
    glm::dvec3 middle_;
    int sign_ = 1; // -1: triangles face inward
};

} // namespace ramus::validate
