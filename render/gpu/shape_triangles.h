// ShapeTriangles: a mesh next to the tree, prepared for drawing by graphics card and caster: relative to the middle of
// its bounds, oriented outward if closed, with a normal at every vertex. An immutable value.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "render/scene/bounds.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::render {

struct ShapeTriangles {
    struct Vertex {
        glm::vec3 position, normal; // position: relative to the middle of `bounds`
    };
    Box bounds; // mm
    // Every edge is shared by exactly two triangles of consistent orientation, facing outward: back faces are
    // invisible.
    bool closed = false;
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;

    ShapeTriangles() = default;
    // Uses the mesh's normals; without any, area-weighted normals of the triangles. Reverses a closed mesh that is
    // inside out, together with its normals if they agree with the triangles.
    explicit ShapeTriangles(const mesh::TriangleMesh& mesh);
};

} // namespace ramus::render
