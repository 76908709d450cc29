// SurfaceProjector: moves points near the surface of a field onto the surface. Pictures divide triangles near the eye
// until no outline shows their edges (render/scene/near_surface.h), and move the new vertices onto the surface with
// this class, so that outlines and creases are those of the field.
//
// Points near contacts follow overlapping rims (rims.h): the surface of each vessel continues inside the other one. The
// result for a point does not depend on the other points or on threads.
#pragma once

#include "core/field/field.h"
#include "core/field/separation.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

class SurfaceProjector {
public:
    // A point near the surface: input and output. Lengths are in mm.
    struct Point {
        using Place = DrawnPoint::Place;
        glm::dvec3 at{0.0};
        std::int32_t branch = 0;
        float cell = 0.0F;           // about the length of the mesh's edges there
        float reach = 0.0F;          // largest move along each axis
        float onward = 0.0F;         // as in Separation::draw()
        glm::vec3 normal{0.0F};      // output, unit length
        bool beside_contact = false; // output
        Place place = Place::kOwn;   // output; other than kOwn only near contacts
    };

    // One field for each vessel system.
    explicit SurfaceProjector(std::vector<Field> fields);

    // Moves points onto the surface, to the resolution of single precision. May be called from any thread.
    void move(std::span<Point> points) const;

private:
    [[nodiscard]] std::size_t field_of(std::int32_t branch) const;

    std::vector<Field> fields_;
    std::vector<std::uint32_t> field_of_branch_; // empty if there is only one field
};

} // namespace ramus::field
