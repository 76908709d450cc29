// A mesh cut into sections that have vertices of their own: what formats with several objects need.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::io {

struct MeshSections {
    struct Section {
        std::size_t first_vertex = 0, vertices = 0;
        std::size_t first_triangle = 0, triangles = 0;
        glm::vec3 least{0.0F}, most{0.0F}; // of the positions
    };
    std::vector<Section> sections;      // as many as asked for; those without a triangle have no vertices
    LargeArray<std::uint32_t> vertices; // of all sections, one after the other: which vertex of the mesh each is
    LargeArray<glm::uvec3> triangles;   // the same; corners count from the section's first vertex
};

// `section_of(triangle)` is below `count`. Vertices and triangles of a section stay in the order in which triangles
// name them. Linear; takes about 24 bytes for a triangle.
[[nodiscard]] MeshSections sections_of(const mesh::TriangleMesh& mesh, std::size_t count,
                                       const std::function<std::size_t(const glm::uvec3&)>& section_of);

} // namespace ramus::io
