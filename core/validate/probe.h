// Probe: what a surface has around a place: whether it is inside, and how wide the cross-section there is. Solids of
// the surface may overlap, as truncated cones do, and the surface may have holes, as where vessels were cut off: inside
// is where most of several rays say so. Any number of threads may ask.
#pragma once

#include "core/measure/deviation/packed_triangles.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::validate {

struct Place;

struct CrossSection {
    bool inside = false;
    // mm: of a circle of the same area, 0 outside. Triangles are chords of the surface that their vertices lie on:
    // `radius` is that of the triangles curved by the normals of their vertices, `flat_radius` that of the triangles
    // themselves.
    double radius = 0.0, flat_radius = 0.0;
    glm::dvec3 middle{0.0}; // of the area
};

class Probe {
public:
    // `places`: those that are to be inside; of a surface that is turned inside out they say so. The surface outlives
    // this.
    Probe(const mesh::TriangleMesh& surface, std::span<const Place> places);

    // Across `direction`. No ray is followed farther than `reach` mm.
    [[nodiscard]] CrossSection cross_section(const glm::dvec3& at, const glm::dvec3& direction, double reach) const;
    [[nodiscard]] bool inside(const glm::dvec3& at) const;
    // Whether the straight way between two places does not meet the surface.
    [[nodiscard]] bool sees(const glm::dvec3& from, const glm::dvec3& to) const;

private:
    [[nodiscard]] int winding(const glm::dvec3& at) const;
    [[nodiscard]] const measure::Crossing* way_out(std::span<const measure::Crossing> crossings, int turns,
                                                   const glm::dvec3& far) const;
    [[nodiscard]] double bulge(const measure::Crossing& crossing, const glm::dvec3& from, const glm::dvec3& way) const;

    const mesh::TriangleMesh& surface_;
    measure::PackedTriangles triangles_;
    double size_; // mm: as far as the surface reaches from anywhere within its box
    glm::dvec3 middle_;
    int sign_ = 1; // -1: triangles are turned inward
};

} // namespace ramus::validate
