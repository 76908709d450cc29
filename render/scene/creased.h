// Finds creased vertices of a surface that is known only by its mesh; edges at these vertices are drawn straight.
#pragma once

#include "render/scene/bent_edge.h"
#include "render/scene/paged_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::render {

[[nodiscard]] inline EdgeEnd end_of(const GpuVertex& v) {
    const glm::vec3 normal(v.normal[0], v.normal[1], v.normal[2]);
    const float length = glm::length(normal);
    return {v.position, length > 0.0F ? normal / length : glm::vec3(0.0F)};
}

// For the vertices that triangles of these pages use, by vertex of the mesh: 1 for vertices whose normals contradict a
// smooth surface through the triangles (creases, walls between vessels), and for vertices up to two triangles away.
[[nodiscard]] std::vector<std::uint8_t> creased_vertices(const PagedMesh& mesh, const std::vector<std::size_t>& pages);

} // namespace ramus::render
