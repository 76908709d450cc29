#include "core/io/meshes/stl.h"

#include "core/io/meshes/assimp_reader.h"
#include "core/io/meshes/mesh_record.h"

#include <glm/geometric.hpp>

namespace ramus::io {

namespace {

std::string header_of(std::uint64_t triangles) {
    // A binary file must not begin with "solid", or programs take it for text.
    std::string header = "ramus " RAMUS_VERSION ", mm, RAS";
    header.resize(80, ' ');
    const auto count = static_cast<std::uint32_t>(triangles);
    header.append(reinterpret_cast<const char*>(&count), sizeof count);
    return header;
}

template <class Positions, class File>
void write_facets(std::span<const glm::uvec3> triangles, const Positions& positions, File& file) {
    Record<50> facet;
    for (const glm::uvec3& t : triangles) {
        const glm::vec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
        // In double precision: the square of a small triangle's area leaves single precision.
        const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double length = glm::length(across);
        facet.put(length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F));
        facet.put(a);
        facet.put(b);
        facet.put(c);
        facet.put(std::uint16_t{0});
        facet.write(file);
    }
}

} // namespace

Result<PolygonSoup> parse_stl(std::string_view text, const std::string& name) {
    return parse_with_assimp(text, "stl", name);
}

void write_stl(const mesh::TriangleMesh& mesh, OutputFile& file) {
    file.write(header_of(mesh.triangles.size()));
    write_facets(mesh.triangles, mesh.positions, file);
}

void keep_stl_vertices(const mesh::VertexSpan& /*more*/, MeshParts& /*parts*/) {}

void keep_stl_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices, MeshParts& parts) {
    write_facets(more, vertices.positions, parts.triangles);
}

void write_stl_parts(MeshParts& parts, OutputFile& file) {
    file.write(header_of(parts.triangle_count));
    parts.triangles.copy_to(file);
}

} // namespace ramus::io
