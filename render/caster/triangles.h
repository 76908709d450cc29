// Triangles of meshes as the caster takes them: in the picture, with what is linear there.
#pragma once

#include "render/caster/cast_types.h"
#include "render/gpu/shape_triangles.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

namespace ramus::render::caster {

struct Corner {
    glm::vec3 at;     // eye space
    glm::vec3 normal; // y up and z towards the eye
};

// How triangles of one kind are seen.
struct TriangleKind {
    bool closed;      // backs are never seen
    float half_width; // as of Body
};

// Appends what can be seen of the triangle in the picture, cut off before the eye. `id` as in ids.glsl.
void project_triangle(const std::array<Corner, 3>& corners, const TriangleKind& kind, std::uint32_t id,
                      const View& view, std::vector<Triangle>& triangles);

// A mesh beside the tree to draw. `id`: kSolid and its number + 1, and kContext where it is no lesion.
struct Body {
    const ShapeTriangles* shape;
    std::uint32_t id;
    bool clear;       // seen through
    float half_width; // pixels, of lines along its triangles' edges; 0: it is a surface
};

// Appends what of it can be seen in the picture: triangles that face the eye, or all where the mesh is open, cut off
// before the eye. `to_eye`: from mm to eye space, depth as +z. The order is the mesh's.
void project_triangles(const Body& body, const View& view, const glm::dmat4& to_eye, std::vector<Triangle>& triangles);

} // namespace ramus::render::caster
