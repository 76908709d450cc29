// ShapeTriangles: a mesh beside the tree as it is drawn, by graphics card and caster alike: relative to the middle of
// its bounds, facing outward where it is closed, with a normal at every vertex. An immutable value.
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
    // Every edge is met once from either side, and triangles face outward: backs are never seen.
    bool closed = false;
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;

    ShapeTriangles() = default;
    // Lit by the mesh's own normals, or by those of its triangles, weighted by their areas. A closed mesh that is
    // inside out is turned, and so are normals that agree with it.
    explicit ShapeTriangles(const mesh::TriangleMesh& mesh);
};

} // namespace ramus::render
