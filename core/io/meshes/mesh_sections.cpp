#include "core/io/meshes/mesh_sections.h"

#include <glm/common.hpp>
#include <limits>

namespace ramus::io {

namespace {

// Gives a section its own vertices and renumbers its triangles. `last_section` and `numbers`: by vertex of the mesh,
// the last section that has it (counted from 1), and its number there.
void take_vertices(MeshSections& cut, std::size_t which, const mesh::TriangleMesh& mesh,
                   LargeArray<std::uint32_t>& last_section, LargeArray<std::uint32_t>& numbers) {
    MeshSections::Section& section = cut.sections[which];
    section.first_vertex = cut.vertices.size();
    section.least = glm::vec3(std::numeric_limits<float>::max());
    section.most = -section.least;
    for (std::size_t t = section.first_triangle; t < section.first_triangle + section.triangles; ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = cut.triangles[t][corner];
            if (last_section[vertex] != which + 1) {
                last_section[vertex] = static_cast<std::uint32_t>(which + 1);
                numbers[vertex] = static_cast<std::uint32_t>(cut.vertices.size() - section.first_vertex);
                cut.vertices.push_back(vertex);
                section.least = glm::min(section.least, mesh.positions[vertex]);
                section.most = glm::max(section.most, mesh.positions[vertex]);
            }
            cut.triangles[t][corner] = numbers[vertex];
        }
    section.vertices = cut.vertices.size() - section.first_vertex;
}

} // namespace

MeshSections sections_of(const mesh::TriangleMesh& mesh, std::size_t count,
                         const std::function<std::size_t(const glm::uvec3&)>& section_of) {
    MeshSections cut{{}, LargeArray<std::uint32_t>(mesh.memory()), LargeArray<glm::uvec3>(mesh.memory())};
    cut.sections.resize(count);
    for (const glm::uvec3& triangle : mesh.triangles) ++cut.sections[section_of(triangle)].triangles;
    std::vector<std::size_t> next(count, 0);
    for (std::size_t i = 1; i < count; ++i)
        next[i] = cut.sections[i].first_triangle = next[i - 1] + cut.sections[i - 1].triangles;
    cut.triangles.resize(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) cut.triangles[next[section_of(triangle)]++] = triangle;
    LargeArray<std::uint32_t> last_section(mesh.positions.size(), 0, mesh.memory()), numbers(last_section);
    cut.vertices.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < count; ++i)
        if (cut.sections[i].triangles > 0) take_vertices(cut, i, mesh, last_section, numbers);
    return cut;
}

} // namespace ramus::io
