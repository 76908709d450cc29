// Projects triangles of meshes into the picture, for the caster.
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

// Properties that the triangles of one mesh share.
struct TriangleKind {
    bool closed;      // back faces are never visible
    float half_width; // see Body
};

// Appends the visible part of the triangle, clipped in front of the eye. `id` as in ids.glsl.
void project_triangle(const std::array<Corner, 3>& corners, const TriangleKind& kind, std::uint32_t id,
                      const View& view, std::vector<Triangle>& triangles);

// A mesh next to the tree: a lesion or context. `id`: kSolid and its number + 1, and kContext unless it is a lesion.
struct Body {
    const ShapeTriangles* shape;
    std::uint32_t id;
    bool clear;       // transparent
    float half_width; // pixels, of lines along triangle edges; 0: a surface
};

// Appends the visible triangles, clipped in front of the eye: those that face the eye, or all if the mesh is open.
// `to_eye`: from mm to eye space, depth as +z. Keeps the mesh's order.
void project_triangles(const Body& body, const View& view, const glm::dmat4& to_eye, std::vector<Triangle>& triangles);

} // namespace ramus::render::caster
