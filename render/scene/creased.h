// Creased vertices of a surface of which nothing is known but its mesh: what is drawn between them stays straight.
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

// By vertex of the mesh, of those that triangles of some pages use: 1 for corners whose normals are not those of a
// smooth surface that the triangles are inscribed in, on creases and beside walls between vessels, and for what is no
// more than two triangles away.
[[nodiscard]] std::vector<std::uint8_t> creased_vertices(const PagedMesh& mesh, const std::vector<std::size_t>& pages);

} // namespace ramus::render
