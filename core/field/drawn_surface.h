// DrawnSurface: the surface that a mesh for pictures is of, for places between the mesh's vertices. A picture of what
// is near the eye divides triangles until no outline shows their edges (render/scene/near_surface.h); this moves the
// new vertices onto the surface itself, so that outlines and creases are those of the field.
//
// Points beside contacts are put as rims are that overlap (rims.h): each vessel goes on along its own surface within
// the other one. Results depend on the points alone, not on threads.
#pragma once

#include "core/field/field.h"
#include "core/field/separation.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

class DrawnSurface {
public:
    // A point near the surface, in and out; mm.
    struct Point {
        using Place = DrawnPoint::Place;
        glm::dvec3 at{0.0};
        std::int32_t branch = 0;
        float cell = 0.0F;           // about the size of the mesh's edges there
        float reach = 0.0F;          // the point stays within so much of where it is, along every axis
        float onward = 0.0F;         // as in BrickField::draw()
        glm::vec3 normal{0.0F};      // out: of unit length
        bool beside_contact = false; // out, and what of it is there if so
        Place place = Place::kOwn;
    };

    // Of systems that have surfaces of their own, a field each.
    explicit DrawnSurface(std::vector<Field> fields);

    // Moves points onto the surface, to what single precision tells of positions. From any thread.
    void move(std::span<Point> points) const;

private:
    [[nodiscard]] std::size_t field_of(std::int32_t branch) const;

    std::vector<Field> fields_;
    std::vector<std::uint32_t> field_of_branch_; // empty: there is one field
};

} // namespace ramus::field
