// Divides a mesh into sections with vertices of their own, for formats with several objects.
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
    std::vector<Section> sections;      // `count` sections; one without triangles has no vertices
    LargeArray<std::uint32_t> vertices; // section by section: the vertex of the mesh
    LargeArray<glm::uvec3> triangles;   // section by section; corners count from the section's first vertex
};

// `section_of(triangle)` must be below `count`. A section keeps its triangles in order, and its vertices in the order
// in which triangles use them. Linear time; takes about 24 bytes for each triangle.
[[nodiscard]] MeshSections sections_of(const mesh::TriangleMesh& mesh, std::size_t count,
                                       const std::function<std::size_t(const glm::uvec3&)>& section_of);

} // namespace ramus::io
